// The tracing behind an error map: pilot bakes of the vertices, and the truth inside the faces.

#include "libprt/transport/error_probe.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "libprt/transport/memory_limit.h"

namespace prt {
namespace {

constexpr int kPilotShare = 16;  // a pilot takes this fraction of the product's rays, ...
constexpr int kLeastPilotRays = 16;
constexpr int kPointShare = 8;        // and a point inside a face this one
constexpr std::size_t kAgain = 2048;  // vertices that are baked a second time
constexpr int kLeastPointRays = 32, kMostPointRays = 256;

std::vector<double> vertexAreas(const TriMesh& mesh) {
  std::vector<double> area(mesh.vertexCount(), 0);
  for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
    for (int k = 0; k < 3; ++k) area[mesh.triangles[t][k]] += double(length(mesh.areaNormal(t))) / 6;
  return area;
}

/// The first `columns` numbers of every row.
Array firstColumns(const Array& array, std::size_t columns) {
  const std::span<const float> values = array.as<float>();
  const auto count = std::size_t(array.shape[0]), width = values.size() / std::max<std::size_t>(count, 1);
  std::vector<float> kept(count * columns);
  for (std::size_t s = 0; s < count; ++s) std::copy_n(&values[s * width], columns, &kept[s * columns]);
  return Array::from<float>(std::span<const float>(kept), {std::int64_t(count), std::int64_t(columns)});
}

std::vector<float> floatsOf(const Array& array) {
  const std::span<const float> values = array.as<float>();
  return {values.begin(), values.end()};
}

/// Bakes points apart from the product, with seeds of their own.
class PilotBaker {
 public:
  PilotBaker(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
             const Transfer& product, const TransferSettings& settings, std::uint64_t seed, Job& job)
      : scene_(std::move(scene)),
        rays_(std::move(rays)),
        product_(product),
        settings_(settings),
        seed_(seed),
        job_(job) {
    settings_.bounces = product.bounces;
    settings_.bands = product.bands;
    settings_.storage = DType::f32;
    settings_.form = TransferForm::Diffuse;
  }

  struct Result {
    std::vector<float> vectors;  // [points, n^2, channels] direct and bounced
    std::vector<float> tail;     // [points, bands^2 - n^2] direct, in the bands beyond the product's
    std::vector<std::uint8_t> buried;
  };

  /// Each `number` is an independent estimate. Direct light in `bands` bands; with `visibility` by the
  /// estimator that bakes visibility too.
  Result bake(const std::shared_ptr<const SampleSet>& points, std::uint64_t number, int rays, int bands,
              const char* phase, bool visibility = false) {
    TransferSettings settings = settings_;
    settings.seed = hashBits(seed_, number, 0x6d617073u);
    settings.rays = rays;
    DirectSettings direct = directSettings(settings, TransferForm::Diffuse);
    direct.bands = bands;
    direct.visibility = visibility;
    direct.phase = phase;
    DirectBake bake(scene_, rays_, points, direct);
    while (!bake.done()) bake.advance(job_);
    DirectTransfer wide = bake.product(job_);
    const auto functions = std::size_t(product_.functions()), all = std::size_t(shCount(bands));
    Result result;
    result.buried = {wide.buried.as<std::uint8_t>().begin(), wide.buried.as<std::uint8_t>().end()};
    const std::span<const float> values = wide.diffuse.as<float>();
    for (std::size_t s = 0; all > functions && s < points->size(); ++s)
      result.tail.insert(result.tail.end(), &values[s * all + functions], &values[s * all] + all);
    wide.settings.bands = product_.bands;
    wide.diffuse = firstColumns(wide.diffuse, functions);
    const Transfer finished =
        finishTransfer(*scene_, *rays_, *points, wide, settings, TransferForm::Diffuse, job_, &product_);
    result.vectors = floatsOf(finished.values);
    return result;
  }

 private:
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const RayScene> rays_;
  const Transfer& product_;
  TransferSettings settings_;
  std::uint64_t seed_;
  Job& job_;
};

/// One point in each of the triangles, anywhere.
SampleSet pointsInside(const Scene& scene, std::size_t most, std::uint64_t seed) {
  std::vector<std::uint32_t> triangles;
  const std::size_t step = std::max<std::size_t>(1, (scene.mesh.triangleCount() + most - 1) / most);
  for (std::size_t t = hashBits(seed, 1, 2) % step; t < scene.mesh.triangleCount(); t += step)
    if (length(scene.mesh.areaNormal(t)) > 0) triangles.push_back(std::uint32_t(t));
  return samplesInTriangles(scene, triangles, seed);
}

/// Independent bakes of the vertices with fewer rays, in more bands.
void probeVertices(PilotBaker& baker, const SampleSet& vertices, const Transfer& transfer,
                   ProbedVertices& found) {
  std::vector<std::uint32_t> all(found.count());
  std::iota(all.begin(), all.end(), 0u);
  const auto points = std::make_shared<const SampleSet>(someSamples(vertices, all));
  const int pilotRays = std::max(kLeastPilotRays, transfer.raysPerSample / kPilotShare);
  for (int k = 0; k < kPilots; ++k) {
    PilotBaker::Result result = baker.bake(points, std::uint64_t(k), pilotRays,
                                           std::max(kErrorBands, found.bands), "error estimate: vertices");
    if (k == 0) found.buried = std::move(result.buried);
    found.pilots[std::size_t(k)] = std::move(result.vectors);
    std::vector<float>& tail = found.tail[std::size_t(k / 2)];
    if (k % 2 == 0) tail.assign(result.tail.size(), 0.0f);
    for (std::size_t i = 0; i < tail.size(); ++i) tail[i] += 0.5f * result.tail[i];
  }
  for (std::size_t s = 0; s < found.count(); ++s)
    if (found.buried[s]) found.area[s] = 0;
}

/// Some vertices exactly as the product has them, but for the seed.
void probeAgain(PilotBaker& baker, const SampleSet& vertices, const Transfer& transfer,
                ProbedVertices& found) {
  const std::size_t step = std::max<std::size_t>(1, (found.count() + kAgain - 1) / kAgain);
  for (std::size_t v = step / 2; v < found.count(); v += step)
    if (!found.buried[v]) found.again.push_back(std::uint32_t(v));
  if (found.again.empty()) return;
  const auto points = std::make_shared<const SampleSet>(someSamples(vertices, found.again));
  const bool visibility = transfer.form != TransferForm::Diffuse;
  found.againVectors = baker
                           .bake(points, kPilots, std::max(1, transfer.raysPerSample), found.bands,
                                 "error estimate: noise", visibility)
                           .vectors;
}

/// The truth inside the faces, twice.
std::shared_ptr<const ProbedPoints> probePoints(PilotBaker& baker, const Scene& scene,
                                                const Transfer& transfer, const ErrorProbeOptions& options) {
  auto inside = std::make_shared<ProbedPoints>();
  const auto places =
      std::make_shared<const SampleSet>(pointsInside(scene, options.mostPoints, options.seed));
  inside->triangle = places->triangle;
  inside->barycentric = places->barycentric;
  const int rays = std::clamp(transfer.raysPerSample / kPointShare, kLeastPointRays, kMostPointRays);
  for (std::size_t h = 0; h < 2; ++h) {
    PilotBaker::Result result =
        baker.bake(places, kPilots + 1 + h, rays, transfer.bands, "error estimate: faces");
    if (h == 0) inside->buried = std::move(result.buried);
    inside->truth[h] = std::move(result.vectors);
  }
  return inside;
}

}  // namespace

bool ErrorProbe::knowsInterpolation() const {
  return points_ != nullptr;
}
std::size_t ErrorProbe::vertexCount() const {
  return vertices_ ? vertices_->count() : 0;
}

ErrorProbe ErrorProbe::measure(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
                               const SampleSet& vertices, std::shared_ptr<const Transfer> transfer,
                               const TransferSettings& settings, Job& job,
                               const std::function<void(ErrorProbe)>& preview,
                               const ErrorProbeOptions& options) {
  const std::size_t count = scene->mesh.vertexCount();
  if (transfer->samples != vertices.size() || vertices.vertices != count)
    throw ValueError(vertices.texels ? "only transfer at the vertices can be judged"
                                     : "the transfer is not of these vertices",
                     "error estimate", "bake with transfer.where=vertex");
  ErrorProbe probe;
  auto found = std::make_shared<ProbedVertices>(scene);
  found->area = vertexAreas(scene->mesh);
  probe.vertices_ = found;
  if (transfer->form == TransferForm::None) return probe;

  found->bands = transfer->bands;
  found->channels = transfer->channels;
  const std::size_t width = found->width(), wide = std::size_t(shCount(kErrorBands));
  requireMemory(sizeof(float) * (count * ((kPilots + 2) * width + 6 * wide) + 2 * options.mostPoints * width),
                "error estimate", "simplify the mesh or use fewer bands");
  found->product = floatsOf(firstColumns(diffuseVectors(*transfer), width));
  found->product.resize(count * width);

  PilotBaker baker(scene, rays, *transfer, settings, options.seed, job);
  probeVertices(baker, vertices, *transfer, *found);
  probeAgain(baker, vertices, *transfer, *found);
  if (preview) preview(probe);
  probe.points_ = probePoints(baker, *scene, *transfer, options);
  return probe;
}

}  // namespace prt
