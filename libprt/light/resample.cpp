#include "libprt/light/resample.h"

#include "libprt/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace prt {
namespace {

/// The part of a texel that lies in a cell of the new map, in solid angle.
struct Overlap {
  std::uint32_t texel, cell;
  float area;
};

/// Borders of rows, as -cos of the polar angle, or of columns, as a share of the turn: ascending.
std::vector<double> rowBorders(int rows) {
  std::vector<double> borders;
  for (int i = 0; i <= rows; ++i) borders.push_back(-std::cos(kPi * i / rows));
  return borders;
}
std::vector<double> columnBorders(int columns) {
  std::vector<double> borders;
  for (int i = 0; i <= columns; ++i) borders.push_back(double(i) / columns);
  return borders;
}

struct Share {
  int from;
  double share;  ///< of the new interval
};

/// For each new interval the old ones that it is made of.
std::vector<std::vector<Share>> shares(const std::vector<double>& from, const std::vector<double>& to) {
  std::vector<std::vector<Share>> result(to.size() - 1);
  std::size_t i = 0;
  for (std::size_t j = 0; j + 1 < to.size(); ++j) {
    while (i > 0 && from[i] > to[j]) --i;
    for (; i + 1 < from.size() && from[i] < to[j + 1]; ++i) {
      const double width = std::min(from[i + 1], to[j + 1]) - std::max(from[i], to[j]);
      if (width > 0) result[j].push_back({int(i), width / (to[j + 1] - to[j])});
    }
  }
  return result;
}

/// Lat-long to lat-long: cells are rectangles in (cosine, azimuth).
Image resampleLatLong(const EnvironmentMap& map, int width, int height, Job& job) {
  const auto rows = shares(rowBorders(map.height()), rowBorders(height));
  const auto columns = shares(columnBorders(map.width()), columnBorders(width));
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    job.checkCancelled();
    for (int x = 0; x < width; ++x) {
      DVec3 sum(0);
      for (const Share& row : rows[std::size_t(y)])
        for (const Share& column : columns[std::size_t(x)])
          sum += row.share * column.share * DVec3(map.pixels().rgb(column.from, row.from));
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = float(sum[c]);
    }
  }
  return image;
}

std::uint32_t pixelIndex(const MapGeometry& g, const Vec2& p) {
  return std::uint32_t(p.y) * std::uint32_t(g.width()) + std::uint32_t(p.x);
}

/// Overlaps of cell (x, y) of a lat-long map: cut into parts x parts pieces of equal solid angle, each taken
/// by the texel at its centre.
void addCell(const MapGeometry& texels, const MapGeometry& cells, int x, int y, int parts,
             std::vector<Overlap>& overlaps) {
  const std::uint32_t cell = pixelIndex(cells, Vec2(x, y));
  const double top = std::cos(kPi * y / cells.height()), bottom = std::cos(kPi * (y + 1) / cells.height());
  const float area = float(cells.solidAngle(x, y) / (parts * parts));
  const auto first = std::ptrdiff_t(overlaps.size());
  for (int part = 0; part < parts * parts; ++part) {
    const double cosine = glm::mix(top, bottom, (part / parts + 0.5) / parts);
    const double sine = std::sqrt(1 - cosine * cosine);
    const double azimuth = ((x + (part % parts + 0.5) / parts) / cells.width() - 0.5) * 2 * kPi;
    const Vec3 d(float(sine * std::sin(azimuth)), float(cosine), float(-sine * std::cos(azimuth)));
    const std::uint32_t texel = pixelIndex(texels, texels.toImage(d));
    const auto known = std::find_if(overlaps.begin() + first, overlaps.end(),
                                    [&](const Overlap& o) { return o.texel == texel; });
    if (known != overlaps.end())
      known->area += area;
    else
      overlaps.push_back({texel, cell, area});
  }
}

/// Overlaps of all texels with all cells, found at a few points per texel.
std::vector<Overlap> findOverlaps(const MapGeometry& texels, const MapGeometry& cells, Job& job) {
  const int parts = std::clamp(int(std::ceil(4 * cells.texelAngle() / texels.texelAngle())), 3, 64);
  std::vector<std::vector<Overlap>> rows(std::size_t(cells.height()));
  parallelFor(job, 0, rows.size(), 1, [&](std::size_t y, std::size_t) {
    for (int x = 0; x < cells.width(); ++x) addCell(texels, cells, x, int(y), parts, rows[y]);
  });
  std::vector<Overlap> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

/// The part of a colour's light above four times the mean of the map: the lamps and suns whose energy must be
/// kept one by one. Below that, exact energy per texel would cost a visible pattern of texel borders.
DVec3 lampPart(const Rgb& c, double mean) {
  const double light = luminance(c);
  return light > 4 * mean ? DVec3(c) * (1 - 4 * mean / light) : DVec3(0);
}

/// Any mapping to lat-long. Overlaps come from sample points: a cell's parts are exact, those of a texel are
/// not, so lamps are scaled to what their texel holds, and the rest, where errors average out, as a whole.
Image resampleAny(const EnvironmentMap& map, int width, int height, Job& job) {
  const MapGeometry& texels = map.geometry();
  const MapGeometry cells(EnvironmentMapping::LatLong, width, height);
  const std::vector<Overlap> overlaps = findOverlaps(texels, cells, job);
  job.checkCancelled();
  std::vector<double> found(map.pixels().pixels(), 0.0);
  for (const Overlap& o : overlaps) found[o.texel] += o.area;

  std::vector<DVec3> plain(map.pixels().pixels(), DVec3(0)), lamp = plain;  // per solid angle found
  std::vector<DVec3> energy(std::size_t(width) * std::size_t(height), DVec3(0));
  DVec3 wanted(0), total(0);
  map.forEachTexel([&](int x, int y, const DVec3& center, double solidAngle, const Rgb& c) {
    const std::uint32_t i = pixelIndex(texels, Vec2(x, y));
    lamp[i] = lampPart(c, luminance(map.report().mean));
    plain[i] = DVec3(c) - lamp[i];
    wanted += solidAngle * DVec3(c);
    if (found[i] > 0)
      lamp[i] *= solidAngle / found[i];
    else
      energy[pixelIndex(cells, cells.toImage(Vec3(center)))] += solidAngle * lamp[i];  // too small to be met
  });
  for (const Overlap& o : overlaps) energy[o.cell] += double(o.area) * (plain[o.texel] + lamp[o.texel]);
  for (const DVec3& e : energy) total += e;

  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const double scale = total[c] > 0 ? wanted[c] / total[c] : 0;
        image.pixel(x, y)[c] =
            float(scale * energy[pixelIndex(cells, Vec2(x, y))][c] / cells.solidAngle(x, y));
      }
  return image;
}

}  // namespace

EnvironmentMap toLatLong(const EnvironmentMap& map, int width, int height) {
  Job patient;
  return toLatLong(map, width, height, patient);
}

EnvironmentMap toLatLong(const EnvironmentMap& map, int width, int height, Job& job) {
  const bool latLong = map.geometry().mapping() == EnvironmentMapping::LatLong;
  return EnvironmentMap(
      latLong ? resampleLatLong(map, width, height, job) : resampleAny(map, width, height, job),
      EnvironmentMapping::LatLong, map.report().source);
}

EnvironmentMap blurredLatLong(const EnvironmentMap& map, double deviation) {
  Job patient;
  return blurredLatLong(map, deviation, patient);
}

EnvironmentMap blurredLatLong(const EnvironmentMap& map, double deviation, Job& job) {
  constexpr int kWidth = 64, kHeight = 32;
  const EnvironmentMap coarse = toLatLong(map, kWidth, kHeight, job);
  struct Texel {
    Vec3 direction;
    float area;
    Rgb radiance;
  };
  std::vector<Texel> texels;
  coarse.forEachTexel([&](int, int, const DVec3& direction, double area, const Rgb& radiance) {
    texels.push_back({Vec3(direction), float(area), radiance});
  });
  // On the sphere a Gaussian is exp((cos - 1) / deviation^2), von Mises and Fisher's.
  const float sharpness = float(1 / (deviation * deviation));
  Image image(kWidth, kHeight, 3);
  parallelFor(job, 0, texels.size(), kWidth, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Rgb sum(0);
      float weights = 0;
      for (const Texel& t : texels) {
        const float w = t.area * std::exp(sharpness * (dot(t.direction, texels[i].direction) - 1));
        sum += w * t.radiance;
        weights += w;
      }
      for (int c = 0; c < 3; ++c) image.data[3 * i + std::size_t(c)] = sum[c] / weights;
    }
  });
  return EnvironmentMap(image, EnvironmentMapping::LatLong, map.report().source);
}

}  // namespace prt
