#include "libprt/mesh/orient.h"

#include "libprt/mesh/cavity.h"
#include "libprt/mesh/edges.h"

namespace prt {
namespace {

constexpr double kCavityWork = 2e8;  // triangle visits spent on telling cavities

/// A connected set of triangles, joined by edges of exactly two.
struct Surface {
  double keptArea = 0, flippedArea = 0;  // of triangles that the walk kept or turned
  double votes = 0;
  double volume = 0;  // as walked
  bool closed = true;
  bool flip = false;  // the walk's result as a whole
  std::uint32_t first = 0;
};

class Orienter {
 public:
  Orienter(const OrientationInput& input, Job& job)
      : in_(input),
        job_(job),
        edges_(input.triangles, job),
        flip_(input.triangles.size(), false),
        surfaceOf_(input.triangles.size(), kNone) {
    edgeOfSide_.assign(3 * input.triangles.size(), kNone);
    for (std::size_t e = 0; e < edges_.size(); ++e)
      for (std::uint32_t side : edges_[e].sides) edgeOfSide_[side] = std::uint32_t(e);
  }

  std::vector<bool> run() {
    for (std::uint32_t f = 0; f < in_.triangles.size(); ++f)
      if (surfaceOf_[f] == kNone) walk(f);
    for (std::uint32_t f = 0; f < in_.triangles.size(); ++f) measure(f);
    findOpen();
    decide();
    for (std::uint32_t f = 0; f < in_.triangles.size(); ++f)
      flip_[f] = flip_[f] != surfaces_[surfaceOf_[f]].flip;
    return std::move(flip_);
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// True when the triangle, as walked, runs along the edge from a to b.
  bool runsForward(std::uint32_t side, const MeshEdge& edge) const {
    return (in_.triangles[side / 3][int(side % 3)] == edge.a) != flip_[side / 3];
  }

  /// Turns everything that hangs together with a triangle the way it is wound.
  void walk(std::uint32_t first) {
    const auto surface = std::uint32_t(surfaces_.size());
    surfaces_.push_back({.first = first});
    surfaceOf_[first] = surface;
    std::vector<std::uint32_t> stack{first};
    for (std::size_t steps = 0; !stack.empty(); ++steps) {
      if (steps % 16384 == 0) job_.checkCancelled();
      const std::uint32_t f = stack.back();
      stack.pop_back();
      for (std::uint32_t side = 3 * f; side < 3 * f + 3; ++side) {
        if (edgeOfSide_[side] == kNone) continue;
        const MeshEdge edge = edges_[edgeOfSide_[side]];
        if (edge.faceCount() != 2) continue;
        const std::uint32_t other = edge.sides[edge.sides[0] == side ? 1 : 0];
        if (surfaceOf_[other / 3] != kNone) continue;
        surfaceOf_[other / 3] = surface;
        flip_[other / 3] = runsForward(side, edge) == runsForward(other, edge);
        stack.push_back(other / 3);
      }
    }
  }

  DVec3 corner(std::uint32_t f, int i) const { return DVec3(in_.positions[in_.triangles[f][i]]); }

  void measure(std::uint32_t f) {
    Surface& surface = surfaces_[surfaceOf_[f]];
    const DVec3 origin = corner(surface.first, 0);
    const DVec3 a = corner(f, 0) - origin, b = corner(f, 1) - origin, c = corner(f, 2) - origin;
    const double area = length(cross(b - a, c - a)), sign = flip_[f] ? -1 : 1;
    (flip_[f] ? surface.flippedArea : surface.keptArea) += area;
    surface.volume += sign * dot(a, cross(b, c));
    if (!in_.normalVotes.empty()) surface.votes += sign * area * in_.normalVotes[f];
  }

  /// A surface is closed when each of its edges has an even number of its sides.
  void findOpen() {
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      const auto sides = edges_[e].sides;
      if (sides.size() == 2) continue;
      for (std::uint32_t side : sides) {
        std::size_t own = 0;
        for (std::uint32_t other : sides.first(std::min<std::size_t>(sides.size(), 64)))
          own += surfaceOf_[other / 3] == surfaceOf_[side / 3];
        if (own % 2 == 1 || sides.size() > 64) surfaces_[surfaceOf_[side / 3]].closed = false;
      }
    }
  }

  void decide() {
    for (Surface& s : surfaces_) {
      const bool disagrees = std::abs(s.votes) > 1e-3 * (s.keptArea + s.flippedArea);
      s.flip = disagrees ? s.votes < 0 : s.flippedArea > s.keptArea;
    }
    if (!in_.outward) return;
    double work = 0;
    for (std::uint32_t i = 0; i < surfaces_.size(); ++i) {
      Surface& s = surfaces_[i];
      const double smallest =
          1e-9 * std::pow(s.keptArea + s.flippedArea, 1.5);  // what encloses nothing has no outside
      const bool inward = s.closed && std::abs(s.volume) > smallest && (s.volume < 0) != s.flip;
      if (!inward) continue;
      work += double(in_.triangles.size());
      if (work > kCavityWork || !insideAnother(i)) s.flip = !s.flip;
    }
  }

  /// True when the other closed surfaces, turned outwards, wind around this one.
  bool insideAnother(std::uint32_t surface) const {
    const DVec3 point = corner(surfaces_[surface].first, 0);
    double angle = 0;
    for (std::uint32_t f = 0; f < in_.triangles.size(); ++f) {
      if (f % 65536 == 0) job_.checkCancelled();
      const Surface& other = surfaces_[surfaceOf_[f]];
      if (surfaceOf_[f] == surface || !other.closed) continue;
      const double sign = (other.volume < 0) != flip_[f] ? -1 : 1;
      angle += sign * signedSolidAngle(point, corner(f, 0), corner(f, 1), corner(f, 2));
    }
    return angle > 2 * kPi;
  }

  const OrientationInput& in_;
  Job& job_;
  const MeshEdges edges_;
  std::vector<bool> flip_;
  std::vector<std::uint32_t> surfaceOf_;
  std::vector<std::uint32_t> edgeOfSide_;
  std::vector<Surface> surfaces_;
};

}  // namespace

std::vector<bool> trianglesToFlip(const OrientationInput& input, Job& job) {
  return Orienter(input, job).run();
}

}  // namespace prt
