#include "libprt/shade/surface_overlay.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/shade/color_map.h"
#include "libprt/shade/raster.h"

#include <algorithm>
#include <limits>

namespace prt {
namespace {

/// A point on the picture.
struct Projected {
  float x = 0, y = 0;  // pixels, from the top left
  float depth = 0;     // linear along straight lines of the picture, see Projector::distance()
  bool inFront = false;
};

class Projector {
 public:
  explicit Projector(const OverlayPicture& picture)
      : camera_(picture.camera),
        axes_(picture.camera.axes()),
        width_(picture.width),
        height_(picture.height) {}

  Projected operator()(const Vec3& p) const {
    const float away = distanceTo(p);
    const auto place = camera_.project(p, width_, height_);
    if (!place || (!camera_.orthographic && !(away > 1e-6f * length(p - camera_.eye)))) return {};
    return {place->x, place->y, camera_.orthographic ? away : 1 / away, true};
  }
  /// Along the optical axis.
  float distanceTo(const Vec3& p) const { return dot(camera_.eye - p, axes_.normal); }
  float distance(float depth) const { return camera_.orthographic ? depth : 1 / depth; }
  /// Whether something at a distance is seen where the surface is at another.
  bool seen(float distance, float surface) const {
    if (camera_.orthographic) return distance <= surface + kMarkLift * length(camera_.eye - camera_.target);
    return distance <= surface * (1 + kMarkLift);
  }

 private:
  const Camera& camera_;
  Frame axes_;
  int width_, height_;
};

/// How much of each pixel marks cover: strongest mark, not the sum, so that what overlaps does not add up.
class MarkCoverage {
 public:
  MarkCoverage(const OverlayPicture& picture, const std::vector<float>& surface, const SurfaceMarks& marks)
      : picture_(picture),
        project_(picture),
        surface_(surface),
        hidden_(marks.hidden),
        fill_(marks.fill),
        scale_(picture.pixelScale * marks.size),
        mark_(surface.size(), 0.0f),
        rim_(surface.size(), 0.0f) {}

  void segment(const Vec3& a, const Vec3& b, float halfWidth) {
    const Projected p = project_(a), q = project_(b);
    if (!p.inFront || !q.inFront) return;
    const float core = halfWidth * scale_, reach = core + kMarkOutline * scale_;
    const Vec2 from(p.x, p.y), along(q.x - p.x, q.y - p.y);
    const float square = dot(along, along);
    overBox(std::min(p.x, q.x) - reach - 1, std::max(p.x, q.x) + reach + 1, std::min(p.y, q.y) - reach - 1,
            std::max(p.y, q.y) + reach + 1, [&](std::size_t pixel, const Vec2& at) {
              const float t = square > 0 ? std::clamp(dot(at - from, along) / square, 0.0f, 1.0f) : 0.0f;
              const float away = length(at - from - t * along);
              const float opacity = opacityAt(pixel, p.depth + t * (q.depth - p.depth));
              raise(mark_[pixel], opacity * std::clamp(core - away + 0.5f, 0.0f, 1.0f));
              raise(rim_[pixel], opacity * std::clamp(reach - away + 0.5f, 0.0f, 1.0f));
            });
  }

  void triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Projected p = project_(a), q = project_(b), r = project_(c);
    if (!p.inFront || !q.inFront || !r.inFront) return;
    const float area = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    if (area == 0) return;
    overBox(std::min({p.x, q.x, r.x}), std::max({p.x, q.x, r.x}), std::min({p.y, q.y, r.y}),
            std::max({p.y, q.y, r.y}), [&](std::size_t pixel, const Vec2& at) {
              const float v = ((at.x - p.x) * (r.y - p.y) - (at.y - p.y) * (r.x - p.x)) / area;
              const float w = ((q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x)) / area;
              if (v < 0 || w < 0 || v + w > 1) return;
              const float depth = p.depth + v * (q.depth - p.depth) + w * (r.depth - p.depth);
              raise(mark_[pixel], fill_ * opacityAt(pixel, depth));
            });
  }

  /// Lays the marks over an image.
  void lay(const Rgb& color, Image& image) const {
    for (std::size_t i = 0; i < mark_.size(); ++i) {
      const float cover = std::max(mark_[i], kRimOpacity * rim_[i]);
      if (cover == 0) continue;
      float* pixel = image.data.data() + 4 * i;
      for (int c = 0; c < 3; ++c) pixel[c] = mark_[i] * color[c] + (1 - cover) * pixel[c];
      pixel[3] = cover + (1 - cover) * pixel[3];
    }
  }

 private:
  static constexpr float kRimOpacity = 0.6f;

  static void raise(float& value, float to) { value = std::max(value, to); }
  float opacityAt(std::size_t pixel, float depth) const {
    return project_.seen(project_.distance(depth), surface_[pixel]) ? 1.0f : hidden_;
  }

  template <class Visit>
  void overBox(float left, float right, float top, float bottom, const Visit& visit) {
    const auto clamped = [](float v, int high) { return int(std::clamp(v, 0.0f, float(high))); };
    const int x0 = clamped(std::floor(left), picture_.width), x1 = clamped(std::ceil(right), picture_.width);
    const int y0 = clamped(std::floor(top), picture_.height),
              y1 = clamped(std::ceil(bottom), picture_.height);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        visit(std::size_t(y) * std::size_t(picture_.width) + std::size_t(x),
              Vec2(float(x) + 0.5f, float(y) + 0.5f));
  }

  const OverlayPicture& picture_;
  Projector project_;
  const std::vector<float>& surface_;  // distance, infinite where nothing is seen
  float hidden_, fill_;
  float scale_;  // pixels per unit of sizes
  std::vector<float> mark_, rim_;
};

Vec3 weightsOf(const Fragment& f) {
  return {1 - f.barycentric.x - f.barycentric.y, f.barycentric.x, f.barycentric.y};
}

Vec3 positionOf(const TriMesh& mesh, const Fragment& f) {
  const UVec3& t = mesh.triangles[f.triangle];
  const Vec3 weight = weightsOf(f);
  return weight.x * mesh.positions[t.x] + weight.y * mesh.positions[t.y] + weight.z * mesh.positions[t.z];
}

/// How much of its colour a fragment shows.
float shadeOf(const TriMesh& mesh, const Fragment& f, const Camera& camera) {
  const UVec3& t = mesh.triangles[f.triangle];
  const Vec3 weight = weightsOf(f);
  const Vec3 n = weight.x * mesh.normals[t.x] + weight.y * mesh.normals[t.y] + weight.z * mesh.normals[t.z];
  const float size = length(n);
  return overlayShade(size > 0 ? dot(n, camera.towardsViewer(positionOf(mesh, f))) / size : 1.0f);
}

/// False colour of one fragment, display-encoded.
Rgb valueColor(const TriMesh& mesh, std::span<const float> values, const Fragment& f) {
  const UVec3& t = mesh.triangles[f.triangle];
  const Vec3 weight = weightsOf(f);
  const bool known = values[t.x] >= 0 && values[t.y] >= 0 && values[t.z] >= 0;
  return magnitudeColor(known ? weight.x * values[t.x] + weight.y * values[t.y] + weight.z * values[t.z]
                              : -1.0f);
}

Rgb pictureColor(const Image& picture, const Vec2& at) {
  const auto texel = [](float t, int size) {
    return std::clamp(int(std::floor(t * float(size))), 0, size - 1);
  };
  return picture.rgb(texel(at.x, picture.width), texel(1 - at.y, picture.height));
}

Rgb paintColor(const SurfacePaint& paint, const Fragment& f) {
  const Rgb color = paint.picture ? Rgb(0) : paint.colors[f.triangle];
  if (paint.uv.empty()) return color;
  const Vec3 weight = weightsOf(f);
  const Vec2* uv = &paint.uv[3 * std::size_t(f.triangle)];
  const Vec2 at = weight.x * uv[0] + weight.y * uv[1] + weight.z * uv[2];
  if (paint.picture) return pictureColor(*paint.picture, at);
  return onDarkSquare(at, paint.squares) ? kDarkSquare * color : color;
}

}  // namespace

Box3 SurfaceMarks::bounds() const {
  Box3 box;
  for (const auto* list : {&points, &edges, &triangles})
    for (const Vec3& p : *list) box.extend(p);
  return box;
}

bool SurfacePaint::fits(std::size_t triangles) const {
  const bool coordinates = uv.size() == 3 * triangles;
  return (colors.empty() || colors.size() == triangles) && (coordinates || (uv.empty() && !picture));
}

void checkPaint(const SurfacePaint& paint, std::size_t triangles) {
  if (!paint.fits(triangles))
    throw ValueError("paint of " + std::to_string(paint.colors.size()) + " colours for a mesh of " +
                         std::to_string(triangles) + " triangles",
                     "overlay", "give one colour for each triangle, and three texture coordinates");
}

Image drawSurfaceOverlay(const TriMesh& mesh, std::span<const float> values, const SurfaceMarks& marks,
                         const OverlayPicture& picture, Job& job) {
  return drawSurfaceOverlay(mesh, values, {}, std::span(&marks, 1), picture, job);
}

Image drawSurfaceOverlay(const TriMesh& mesh, std::span<const float> values, const SurfacePaint& paint,
                         std::span<const SurfaceMarks> marks, const OverlayPicture& picture, Job& job) {
  if (!values.empty() && values.size() != mesh.vertexCount())
    throw ValueError("an overlay of " + std::to_string(values.size()) + " values for a mesh of " +
                         std::to_string(mesh.vertexCount()) + " vertices",
                     "overlay", "give one value for each vertex");
  checkPaint(paint, mesh.triangleCount());
  const bool painted = paint.covers();
  Image image(picture.width, picture.height, 4);
  std::vector<float> surface(std::size_t(picture.width) * std::size_t(picture.height),
                             std::numeric_limits<float>::infinity());
  const Projector project(picture);
  const Rasterizer rasterizer(mesh, picture.camera, picture.width, picture.height, picture.grid, job);
  const float whole = float(picture.grid * picture.grid);
  parallelFor(job, 0, rasterizer.tileCount(), 1, [&](std::size_t tile, std::size_t) {
    SampleTile samples;
    FragmentTile fragments;
    rasterizer.drawFragments(tile, samples, fragments);
    for (int y = 0; y < fragments.height; ++y)
      for (int x = 0; x < fragments.width; ++x) {
        float* out = image.pixel(fragments.x + x, fragments.y + y);
        float& nearest =
            surface[std::size_t(fragments.y + y) * std::size_t(picture.width) + std::size_t(fragments.x + x)];
        for (const Fragment& f : fragments.pixel(std::size_t(y * fragments.width + x))) {
          nearest = std::min(nearest, project.distanceTo(positionOf(mesh, f)));
          if (values.empty() && !painted) continue;
          const float share = float(f.samples) / whole;
          const Rgb color = shadeOf(mesh, f, picture.camera) *
                            (painted ? paintColor(paint, f) : valueColor(mesh, values, f));
          for (int c = 0; c < 3; ++c) out[c] += share * color[c];
          out[3] += share;
        }
      }
  });
  const auto lay = [&](const SurfaceMarks& layer) {
    if (layer.empty()) return;
    MarkCoverage coverage(picture, surface, layer);
    for (std::size_t i = 0; i + 2 < layer.triangles.size(); i += 3)
      coverage.triangle(layer.triangles[i], layer.triangles[i + 1], layer.triangles[i + 2]);
    for (std::size_t i = 0; i + 1 < layer.edges.size(); i += 2)
      coverage.segment(layer.edges[i], layer.edges[i + 1], kMarkHalfWidth);
    for (const Vec3& p : layer.points) coverage.segment(p, p, kMarkRadius);
    coverage.lay(layer.color, image);
  };
  lay(paint.seams);
  for (const SurfaceMarks& layer : marks) lay(layer);
  return image;
}

}  // namespace prt
