#include "libprt/meso/height_field.h"

#include "libprt/core/error.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

/// Two triangles per cell of a grid of (columns + 1) x (rows + 1) vertices that starts at `first`; the
/// shorter diagonal of each cell, by height.
void appendCells(TriMesh& mesh, std::uint32_t first, int columns, int rows) {
  const auto at = [&](int i, int j) { return first + std::uint32_t(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const auto z = [&](std::uint32_t v) { return mesh.positions[v].z; };
      if (std::abs(z(a) - z(c)) <= std::abs(z(b) - z(d))) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
}

/// Mean luminance of the pixels that fall into each cell of a smaller grid, rows from the bottom.
HeightGrid reduced(const Image& image, int columns, int rows) {
  HeightGrid grid{columns, rows, std::vector<float>(std::size_t(columns) * std::size_t(rows))};
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const int x0 = i * image.width / columns, x1 = std::max(x0 + 1, (i + 1) * image.width / columns);
      const int y0 = j * image.height / rows, y1 = std::max(y0 + 1, (j + 1) * image.height / rows);
      double sum = 0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += luminance(image.rgb(x, image.height - 1 - y));
      grid.heights[std::size_t(j) * std::size_t(columns) + std::size_t(i)] =
          float(sum / ((x1 - x0) * (y1 - y0)));
    }
  return grid;
}

}  // namespace

HeightGrid sampleHeights(int side, const std::function<float(const Vec2& uv)>& height) {
  HeightGrid grid{side, side, {}};
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) grid.heights.push_back(height(Vec2(float(i), float(j)) / float(side)));
  return grid;
}

HeightGrid heightsFromImage(const Image& image, float depth, int mostSide) {
  if (image.empty() || image.width < 2 || image.height < 2)
    throw ValueError("has no pixels to take heights from", "patch.heightmap",
                     "use an image of 2 x 2 or more");
  HeightGrid grid = reduced(image, std::min(image.width, mostSide), std::min(image.height, mostSide));
  for (const float h : grid.heights)
    if (!std::isfinite(h))
      throw ValueError("has a pixel that is not a finite number", "patch.heightmap", "repair the image");
  const auto [low, high] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  const float base = *low, range = *high - *low;
  if (!(range > 0))
    throw ValueError("is the same height everywhere", "patch.heightmap",
                     "use an image with light and dark places, or patch.model=flat");
  for (float& h : grid.heights) h = (h - base) / range * depth;
  return grid;
}

Patch heightField(const HeightGrid& grid, const Rgb& albedo, Job* job) {
  if (grid.columns < 2 || grid.rows < 2 || grid.columns > kMaxHeightGrid || grid.rows > kMaxHeightGrid)
    throw ValueError("cannot make a surface of " + std::to_string(grid.columns) + " x " +
                         std::to_string(grid.rows) + " heights",
                     "patch", "use 2 to " + std::to_string(kMaxHeightGrid) + " a side");
  TriMesh mesh;
  for (int j = 0; j <= grid.rows; ++j)
    for (int i = 0; i <= grid.columns; ++i)
      mesh.positions.emplace_back(float(i) / float(grid.columns), float(j) / float(grid.rows), grid.at(i, j));
  appendCells(mesh, 0, grid.columns, grid.rows);
  return makePatch(std::move(mesh), {albedo}, job);
}

Patch flatPatch(const Rgb& albedo) {
  TriMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.normals.assign(4, Vec3(0, 0, 1));
  mesh.triangles = {{0, 1, 3}, {0, 3, 2}};
  return makePatch(std::move(mesh), {albedo});
}

Patch vGroove(double openingAngle, int cells, const Rgb& albedo) {
  TriMesh mesh;
  const double half = openingAngle / 2, depth = 0.5 / std::tan(half);
  for (const int wall : {0, 1}) {
    const auto first = std::uint32_t(mesh.vertexCount());
    const Vec3 normal(float(wall == 0 ? std::cos(half) : -std::cos(half)), 0, float(std::sin(half)));
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= cells; ++i) {
        const double u = (wall + double(i) / cells) / 2;
        mesh.positions.emplace_back(float(u), 0.5f * float(j), float(depth * 2 * std::abs(u - 0.5)));
        mesh.normals.push_back(normal);
      }
    appendCells(mesh, first, cells, 2);
  }
  return makePatch(std::move(mesh), {albedo});
}

}  // namespace prt
