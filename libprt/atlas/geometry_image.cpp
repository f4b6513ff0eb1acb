#include "libprt/atlas/geometry_image.h"

#include "libprt/core/parallel.h"
#include "libprt/mesh/cancel_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <unordered_map>

namespace prt {
namespace {

/// Twice the area of (a, b, p) with a rounding that does not depend on which triangle asks: exactly opposite
/// for the edge seen from its two sides.
double side(const DVec2& a, const DVec2& b, const DVec2& p) {
  const auto area = [&p](const DVec2& from, const DVec2& to) {
    return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
  };
  const bool ordered = a.x != b.x ? a.x < b.x : a.y < b.y;
  return ordered ? area(a, b) : -area(b, a);
}

/// A centre exactly on an edge belongs to the triangle for which it is a left edge, or a top one if level.
bool owns(const DVec2& a, const DVec2& b) {
  return a.y != b.y ? a.y > b.y : a.x > b.x;
}

struct Corners {
  DVec2 p[3];
  explicit Corners(const Atlas& atlas, std::uint32_t t)
      : p{DVec2(atlas.uv[atlas.uvTriangles[t].x]), DVec2(atlas.uv[atlas.uvTriangles[t].y]),
          DVec2(atlas.uv[atlas.uvTriangles[t].z])} {}
};

/// Calls found(texel, weights of corners 1 and 2) for every centre in a triangle.
template <class Found>
void forCentres(Corners c, int size, const Found& found) {
  const bool mirrored = side(c.p[0], c.p[1], c.p[2]) < 0;
  if (mirrored) std::swap(c.p[1], c.p[2]);
  DVec2 low = min(c.p[0], min(c.p[1], c.p[2])), high = max(c.p[0], max(c.p[1], c.p[2]));
  const int x0 = std::max(0, int(std::ceil(low.x * size - 0.5))),
            x1 = std::min(size - 1, int(std::floor(high.x * size - 0.5)));
  const int y0 = std::max(0, int(std::ceil((1 - high.y) * size - 0.5)) - 1);
  const int y1 = std::min(size - 1, int(std::floor((1 - low.y) * size - 0.5)) + 1);
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const DVec2 p = texelCentre(size, x, y);
      double w[3];
      bool inside = true;
      for (int i = 0; i < 3 && inside; ++i) {
        const DVec2 &a = c.p[(i + 1) % 3], &b = c.p[(i + 2) % 3];
        w[i] = side(a, b, p);
        inside = w[i] > 0 || (w[i] == 0 && owns(a, b));
      }
      if (!inside) continue;
      const double sum = w[0] + w[1] + w[2];
      if (mirrored) std::swap(w[1], w[2]);
      found(x, y, sum > 0 ? DVec2(w[1], w[2]) / sum : DVec2(0));
    }
}

/// Calls found(x, y, t) for every texel that a segment passes through, t of the point nearest to its centre.
template <class Found>
void forTexelsOnSegment(const DVec2& a, const DVec2& b, int size, const Found& found) {
  const DVec2 p = DVec2(a.x, 1 - a.y) * double(size),
              q = DVec2(b.x, 1 - b.y) * double(size);  // in texels, y down
  const DVec2 d = q - p;
  const double length2 = dot(d, d);
  const int y0 = int(std::floor(std::min(p.y, q.y))), y1 = int(std::floor(std::max(p.y, q.y)));
  for (int y = std::max(0, y0); y <= std::min(size - 1, y1); ++y) {
    // The part of the segment in this row.
    double t0 = 0, t1 = 1;
    if (d.y != 0) {
      const double ta = (y - p.y) / d.y, tb = (y + 1 - p.y) / d.y;
      t0 = std::clamp(std::min(ta, tb), 0.0, 1.0);
      t1 = std::clamp(std::max(ta, tb), 0.0, 1.0);
    }
    const double xa = p.x + t0 * d.x, xb = p.x + t1 * d.x;
    const int x0 = std::max(0, int(std::floor(std::min(xa, xb)))),
              x1 = std::min(size - 1, int(std::floor(std::max(xa, xb))));
    for (int x = x0; x <= x1; ++x) {
      const DVec2 centre(x + 0.5, y + 0.5);
      found(x, y, length2 > 0 ? std::clamp(dot(centre - p, d) / length2, 0.0, 1.0) : 0.0);
    }
  }
}

/// Sides of triangles that no other triangle shares in the texture: corner that each starts at.
std::vector<std::uint32_t> rimSides(const Atlas& atlas) {
  struct Side {
    std::uint64_t key;
    std::uint32_t corner;
  };
  std::vector<Side> sides;
  sides.reserve(3 * atlas.triangleCount());
  for (std::uint32_t t = 0; t < atlas.triangleCount(); ++t)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = atlas.uvTriangles[t][int(i)], b = atlas.uvTriangles[t][int((i + 1) % 3)];
      sides.push_back({(std::uint64_t(std::min(a, b)) << 32) | std::max(a, b), 3 * t + i});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return x.key != y.key ? x.key < y.key : x.corner < y.corner;
  });
  std::vector<std::uint32_t> rim;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    while (end < sides.size() && sides[end].key == sides[i].key) ++end;
    if (end == i + 1) rim.push_back(sides[i].corner);
    i = end;
  }
  std::sort(rim.begin(), rim.end());
  return rim;
}

/// Weights of corners 1 and 2 at a point along the side that starts at a corner.
Vec2 alongSide(std::uint32_t corner, double t) {
  double w[3] = {0, 0, 0};
  w[corner % 3] = 1 - t;
  w[(corner + 1) % 3] = t;
  return Vec2(float(w[1]), float(w[2]));
}

void dilate(GeometryImage& image, int rings, Job& job) {
  // Each ring takes, of the neighbours that had a point before it, the one whose source is nearest.
  std::vector<std::int32_t> source(image.kind.size(), -1);
  std::vector<std::uint32_t> front, next;
  for (std::uint32_t i = 0; i < image.kind.size(); ++i)
    if (image.kind[i] != TexelKind::Empty) source[i] = std::int32_t(i);
  const int size = image.size;
  const auto neighbours = [size](std::uint32_t i, const std::function<void(std::uint32_t)>& visit) {
    const int x = int(i) % size, y = int(i) / size;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if ((dx != 0 || dy != 0) && x + dx >= 0 && x + dx < size && y + dy >= 0 && y + dy < size)
          visit(std::uint32_t((y + dy) * size + x + dx));
  };
  for (std::uint32_t i = 0; i < source.size(); ++i) {
    if (i % 65536 == 0) job.checkCancelled();
    if (source[i] >= 0)
      neighbours(i, [&](std::uint32_t k) {
        if (source[k] < 0) front.push_back(k);
      });
  }
  for (int ring = 0; ring < rings && !front.empty(); ++ring) {
    job.checkCancelled();
    std::sort(front.begin(), front.end());
    front.erase(std::unique(front.begin(), front.end()), front.end());
    std::vector<std::int32_t> chosen(front.size(), -1);
    for (std::size_t n = 0; n < front.size(); ++n) {
      const int x = int(front[n]) % size, y = int(front[n]) / size;
      int least = 1 << 30;
      neighbours(front[n], [&](std::uint32_t k) {
        if (source[k] < 0) return;
        const int dx = source[k] % size - x, dy = source[k] / size - y, d = dx * dx + dy * dy;
        if (d < least) least = d, chosen[n] = source[k];
      });
    }
    next.clear();
    for (std::size_t n = 0; n < front.size(); ++n) {
      const std::uint32_t i = front[n];
      source[i] = chosen[n];
      image.triangle[i] = image.triangle[std::size_t(chosen[n])];
      image.barycentric[i] = image.barycentric[std::size_t(chosen[n])];
      image.kind[i] = TexelKind::Gutter;
    }
    for (std::uint32_t i : front)
      neighbours(i, [&](std::uint32_t k) {
        if (source[k] < 0) next.push_back(k);
      });
    front.swap(next);
  }
}

}  // namespace

double GeometryImage::filled() const {
  std::size_t count = 0;
  for (TexelKind k : kind) count += k == TexelKind::Inside || k == TexelKind::Border;
  return kind.empty() ? 0 : double(count) / double(kind.size());
}

GeometryImage makeGeometryImage(const Atlas& atlas, int size, int rings, Job& job) {
  GeometryImage image;
  image.size = size;
  const std::size_t texels = std::size_t(size) * std::size_t(size);
  image.triangle.assign(texels, kNowhere);
  image.barycentric.assign(texels, Vec2(0));
  image.kind.assign(texels, TexelKind::Empty);
  CancelCheck check(job);
  for (std::uint32_t t = 0; t < atlas.triangleCount(); ++t) {
    check();
    forCentres(Corners(atlas, t), size, [&](int x, int y, const DVec2& weights) {
      const std::size_t i = image.index(x, y);
      image.triangle[i] = t;
      image.barycentric[i] = Vec2(weights);
      image.kind[i] = TexelKind::Inside;
    });
  }
  // Texels that a chart reaches into past their centre are crossed by its rim: the nearest point of that.
  std::unordered_map<std::size_t, double> nearest;
  for (std::uint32_t corner : rimSides(atlas)) {
    check();
    const Corners c(atlas, corner / 3);
    const DVec2 a = c.p[corner % 3], b = c.p[(corner + 1) % 3];
    forTexelsOnSegment(a, b, size, [&](int x, int y, double t) {
      const std::size_t i = image.index(x, y);
      if (image.kind[i] == TexelKind::Inside) return;
      const double distance = glm::distance(glm::mix(a, b, t), texelCentre(size, x, y));
      const auto [place, isNew] = nearest.try_emplace(i, distance);
      if (!isNew && place->second <= distance) return;
      place->second = distance;
      image.triangle[i] = corner / 3;
      image.barycentric[i] = alongSide(corner % 3, t);
      image.kind[i] = TexelKind::Border;
    });
  }
  dilate(image, rings < 0 ? atlas.gutter : rings, job);
  return image;
}

std::vector<TexelOverlap> overlappingTexels(const Atlas& atlas, int size, Job& job, bool rims) {
  std::vector<std::uint32_t> owner(std::size_t(size) * std::size_t(size), kNowhere);
  std::vector<std::pair<std::size_t, TexelOverlap>> found;
  const auto at = [size](int x, int y) { return std::size_t(y) * std::size_t(size) + std::size_t(x); };
  CancelCheck check(job);
  for (std::uint32_t t = 0; t < atlas.triangleCount(); ++t) {
    check();
    forCentres(Corners(atlas, t), size, [&](int x, int y, const DVec2&) {
      std::uint32_t& o = owner[at(x, y)];
      if (o == kNowhere)
        o = t;
      else
        found.push_back({at(x, y), {o, t, Vec2(texelCentre(size, x, y))}});
    });
  }
  for (std::uint32_t corner : rims ? rimSides(atlas) : std::vector<std::uint32_t>{}) {
    check();
    const Corners c(atlas, corner / 3);
    forTexelsOnSegment(c.p[corner % 3], c.p[(corner + 1) % 3], size, [&](int x, int y, double) {
      std::uint32_t& o = owner[at(x, y)];
      if (o == kNowhere)
        o = corner / 3;
      else if (atlas.chartOf[o] != atlas.chartOf[corner / 3])
        found.push_back({at(x, y), {o, corner / 3, Vec2(texelCentre(size, x, y))}});
    });
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<TexelOverlap> overlaps;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (i == 0 || found[i].first != found[i - 1].first) overlaps.push_back(found[i].second);
  return overlaps;
}

TexelSurface texelSurface(const TriMesh& mesh, const Atlas& atlas, const GeometryImage& image, Job& job) {
  TexelSurface surface;
  const std::size_t texels = image.kind.size();
  surface.position.assign(texels, Vec3(0));
  surface.normal.assign(texels, Vec3(0));
  surface.tangent.assign(texels, Vec3(0));
  parallelFor(job, 0, texels, 16384, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (image.kind[i] == TexelKind::Empty) continue;
      const UVec3 &v = mesh.triangles[image.triangle[i]], &u = atlas.uvTriangles[image.triangle[i]];
      const float b = image.barycentric[i].x, c = image.barycentric[i].y, a = 1 - b - c;
      surface.position[i] = a * mesh.positions[v.x] + b * mesh.positions[v.y] + c * mesh.positions[v.z];
      const Vec3 n = a * mesh.normals[v.x] + b * mesh.normals[v.y] + c * mesh.normals[v.z];
      const Vec3 normal = glm::length(n) > 0 ? glm::normalize(n) : mesh.normals[v.x];
      surface.normal[i] = normal;
      // Along growing u: the gradient of position by texture coordinates.
      const DVec2 du(atlas.uv[u.y] - atlas.uv[u.x]), dv(atlas.uv[u.z] - atlas.uv[u.x]);
      const DVec3 e1(mesh.positions[v.y] - mesh.positions[v.x]),
          e2(mesh.positions[v.z] - mesh.positions[v.x]);
      DVec3 tangent = e1 * dv.y - e2 * du.y;
      tangent -= DVec3(normal) * glm::dot(DVec3(normal), tangent);
      const double length = glm::length(tangent);
      surface.tangent[i] = length > 0 ? Vec3(tangent / length) : frameFromNormal(normal).tangent;
    }
  });
  return surface;
}

BackProjection backProject(const Atlas& atlas, const GeometryImage& image, Job& job) {
  BackProjection result;
  CancelCheck check(job);
  for (int y = 0; y < image.size; ++y)
    for (int x = 0; x < image.size; ++x) {
      check();
      const std::size_t i = image.index(x, y);
      if (image.kind[i] == TexelKind::Empty) continue;
      const Vec2 w = image.barycentric[i];
      if (!(w.x >= 0 && w.y >= 0 && w.x + w.y <= 1.000001f)) ++result.outsideTriangle;
      if (image.kind[i] == TexelKind::Gutter) continue;
      const Corners c(atlas, image.triangle[i]);
      const DVec2 p = c.p[0] * (1.0 - w.x - w.y) + c.p[1] * double(w.x) + c.p[2] * double(w.y);
      double& worst = image.kind[i] == TexelKind::Inside ? result.inside : result.border;
      worst = std::max(worst, glm::distance(p, texelCentre(image.size, x, y)) * image.size);
    }
  return result;
}

}  // namespace prt
