#include "libprt/synthesis/neighbourhoods.h"

#include "libprt/core/parallel.h"
#include "libprt/synthesis/orientation_field.h"

#include <bit>
#include <cmath>

namespace prt {
namespace {

Vec2 inFrame(const Vec3& d, const Vec3& tangent, const Vec3& normal) {
  const Vec2 flat(dot(d, tangent), dot(d, cross(normal, tangent)));
  const float size = length(flat);
  return size > 1e-20f ? flat / size : Vec2(1, 0);
}

Vec2 turned(const Vec2& v, double angle) {
  const float c = float(std::cos(angle)), s = float(std::sin(angle));
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

}  // namespace

std::vector<Vec3> mesoTangents(const MesoMesh& meso, const TangentFrames& frames, Job& job) {
  std::vector<Vec3> tangents(meso.vertexCount());
  parallelFor(job, 0, tangents.size(), 16384, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      tangents[i] = tangentAt(frames, meso.triangle[i], meso.barycentric[i], meso.normals[i]);
  });
  return tangents;
}

Neighbourhoods makeNeighbourhoods(const MesoMesh& meso, const SurfaceSheets& sheets,
                                  std::span<const Vec3> tangents, int symmetry, double unit, int level,
                                  Job& job) {
  Neighbourhoods n;
  n.rings = mesoRings(meso, sheets, level, job);
  n.offset.resize(n.rings.list.size());
  if (symmetry > 1) n.turn.resize(n.rings.list.size());
  const double step = 2 * kPi / symmetry;
  parallelFor(job, 0, n.count(), 8192, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
      for (std::uint32_t slot = n.rings.start[p]; slot < n.rings.start[p + 1]; ++slot) {
        const std::uint32_t q = n.rings.list[slot];
        const Vec3 d = meso.positions[q] - meso.positions[p];
        const Vec2 here = inFrame(d, tangents[p], meso.normals[p]);
        Vec2 there = inFrame(d, tangents[q], meso.normals[q]);
        if (symmetry > 1) {
          // The same way seen from both ends tells how the frames are turned.
          const double angle =
              std::atan2(double(here.y), double(here.x)) - std::atan2(double(there.y), double(there.x));
          const int turn = int(std::lround(angle / step));
          n.turn[slot] = std::uint8_t(((turn % symmetry) + symmetry) % symmetry);
          there = turned(there, turn * step);
        }
        const Vec2 mean = here + there;
        n.offset[slot] = (dot(mean, mean) > 1e-6f ? normalize(mean) : here) * (length(d) * float(unit));
      }
  });
  return n;
}

std::vector<std::vector<std::uint32_t>> independentSets(const PointRings& rings) {
  std::vector<std::uint8_t> colour(rings.count(), 0);  // 0 = none yet
  std::vector<std::vector<std::uint32_t>> sets;
  for (std::uint32_t p = 0; p < rings.count(); ++p) {
    std::uint64_t used = 1;
    for (const std::uint32_t q : rings.of(p)) used |= std::uint64_t{1} << std::min<int>(colour[q], 63);
    const int free = std::countr_one(used);
    colour[p] = std::uint8_t(free);
    if (std::size_t(free) > sets.size()) sets.emplace_back();
    sets[std::size_t(free) - 1].push_back(p);
  }
  return sets;
}

}  // namespace prt
