#include "libprt/transport/area_means.h"

#include "libprt/core/sampling.h"
#include "libprt/core/warp.h"

#include <algorithm>

namespace prt {
namespace {

constexpr int kShareOfRays = 16;
constexpr int kLeastRays = 64;
constexpr std::size_t kBatches = 16;

/// A point on one side of a triangle, as paths that bounce see it.
void addPoint(SampleSet& set, const Scene& scene, std::uint32_t triangle, const Vec2& b, float side) {
  const TriMesh& mesh = scene.mesh;
  const UVec3& t = mesh.triangles[triangle];
  const Vec3 face = side * Vec3(normalize(DVec3(mesh.areaNormal(triangle))));
  const Vec3 smooth = (1 - b.x - b.y) * mesh.normals[t.x] + b.x * mesh.normals[t.y] + b.y * mesh.normals[t.z];
  const float size = length(smooth);
  set.origin.push_back(offsetOrigin(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], b, face));
  set.geometricNormal.push_back(face);
  set.shadingNormal.push_back(size > 1e-6f ? side / size * smooth : face);
  set.triangle.push_back(triangle);
  set.barycentric.push_back(b);
}

/// What a bake may refer to without owning it.
template <class T>
std::shared_ptr<const T> borrowed(const T& what) {
  return std::shared_ptr<const T>(std::shared_ptr<void>(), &what);
}

/// Direct transfer at some of `all` points, for the light of `vertices`.
DirectTransfer bakeAt(const Scene& scene, const RayScene& rays, const SampleSet& points, std::size_t batch,
                      std::size_t all, const DirectTransfer& vertices, std::size_t hitMemory, Job& job) {
  DirectSettings settings = vertices.settings;
  settings.visibility = false;
  settings.rays = std::max(kLeastRays, vertices.raysPerSample / kShareOfRays);
  settings.seed = hashBits(vertices.settings.seed, batch, 0x61726561);
  settings.hitMemory = hitMemory;
  settings.phase = "area means";
  settings.phaseRays = double(all) * settings.rays;
  settings.phaseRaysBefore = double(batch) / kBatches * settings.phaseRays;
  DirectBake bake(borrowed(scene), borrowed(rays), borrowed(points), settings);
  while (!bake.done()) bake.advance(job);
  return bake.product(job);
}

}  // namespace

SampleSet pointsInTriangles(const Scene& scene, std::uint64_t seed) {
  SampleSet set;
  for (const float side : {1.0f, -1.0f})
    for (std::uint32_t t = 0; t < scene.mesh.triangleCount(); ++t) {
      if (side < 0 && !scene.materialOf(t).twoSided) continue;
      if (!(length(DVec3(scene.mesh.areaNormal(t))) > 0)) continue;
      addPoint(set, scene, t,
               sampleTriangle({hashUniform(seed, t, 0x61726561), hashUniform(seed, t, 0x6d65616e)}), side);
    }
  return set;
}

/// Every kBatches-th point.
struct AreaMeans::Batch {
  Batch(const AreaMeans& all, std::size_t number, const RayScene& rays, const DirectTransfer& vertices,
        std::size_t hitMemory, Job& job)
      : places(placesOf(all.points_.size(), number)),
        points(someSamples(all.points_, places)),
        direct(bakeAt(all.scene_, rays, points, number, all.points_.size(), vertices, hitMemory, job)),
        gather(all.scene_, rays, all.surface_, points, direct, hitMemory) {}

  static std::vector<std::uint32_t> placesOf(std::size_t count, std::size_t number) {
    std::vector<std::uint32_t> places;
    for (std::size_t p = number; p < count; p += kBatches) places.push_back(std::uint32_t(p));
    return places;
  }

  std::vector<std::uint32_t> places;  // of its points among all
  SampleSet points;
  DirectTransfer direct;
  BounceGather gather;
};

AreaMeans::AreaMeans(const Scene& scene, const RayScene& rays, const SampleSet& surface,
                     const DirectTransfer& direct, std::size_t hitMemory, Job& job)
    : scene_(scene),
      surface_(surface),
      points_(pointsInTriangles(scene, direct.settings.seed)),
      direct_(points_.size(), std::size_t(direct.diffuse.shape[1])),
      buried_(points_.size(), 0) {
  // Triangle numbers rise among the fronts and start again with the backs.
  fronts_ = 0;
  while (fronts_ < points_.size() &&
         (fronts_ == 0 || points_.triangle[fronts_] > points_.triangle[fronts_ - 1]))
    ++fronts_;
  for (std::size_t b = 0; b < std::min(kBatches, points_.size()); ++b) {
    batches_.push_back(std::make_unique<Batch>(*this, b, rays, direct, hitMemory / kBatches, job));
    const Batch& batch = *batches_.back();
    const std::span<const float> e = batch.direct.diffuse.as<float>();
    for (std::size_t i = 0; i < batch.places.size(); ++i) {
      std::copy_n(&e[i * direct_.width], direct_.width, direct_.row(batch.places[i]));
      buried_[batch.places[i]] = batch.direct.buried.as<std::uint8_t>()[i];
    }
  }
}

AreaMeans::~AreaMeans() = default;

double AreaMeans::rayCount() const {
  double sum = 0;
  for (const auto& batch : batches_) sum += batch->gather.rayCount();
  return sum;
}

SampleRows AreaMeans::gather(const SampleRows& leaving, Job& job) {
  SampleRows all(points_.size(), leaving.width);
  for (const auto& batch : batches_) {
    const SampleRows rows = batch->gather.irradiance(leaving, job);
    for (std::size_t i = 0; i < rows.count(); ++i)
      std::copy_n(rows.row(i), rows.stride, all.row(batch->places[i]));
  }
  return all;
}

std::array<std::uint32_t, 3> AreaMeans::cornersOf(std::size_t point) const {
  const UVec3& t = scene_.mesh.triangles[points_.triangle[point]];
  if (point < fronts_) return {t.x, t.y, t.z};
  return {surface_.back[t.x], surface_.back[t.y], surface_.back[t.z]};
}

SampleRows AreaMeans::corrected(const SampleRows& atVertices, const SampleRows& atPoints) const {
  SampleRows sum(atVertices.count(), atVertices.width);
  std::vector<float> area(atVertices.count(), 0.0f), off(atVertices.stride);
  for (std::size_t p = 0; p < points_.size(); ++p) {
    if (buried_[p]) continue;
    const std::array<std::uint32_t, 3> corner = cornersOf(p);
    const Vec2 b = points_.barycentric[p];
    const std::array<float, 3> weight{1 - b.x - b.y, b.x, b.y};
    std::copy_n(atPoints.row(p), off.size(), off.begin());
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < off.size(); ++i) off[i] -= weight[k] * atVertices.row(corner[k])[i];
    const auto share = float(length(DVec3(scene_.mesh.areaNormal(points_.triangle[p]))));
    for (const std::uint32_t v : corner) {
      area[v] += share;
      for (std::size_t i = 0; i < off.size(); ++i) sum.row(v)[i] += share * off[i];
    }
  }
  for (std::size_t v = 0; v < sum.count(); ++v)
    for (std::size_t i = 0; i < sum.stride; ++i)
      sum.row(v)[i] = atVertices.row(v)[i] + (area[v] > 0 ? sum.row(v)[i] / area[v] : 0.0f);
  return sum;
}

}  // namespace prt
