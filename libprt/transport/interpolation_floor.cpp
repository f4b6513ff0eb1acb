#include "libprt/transport/interpolation_floor.h"

#include "libprt/core/error.h"
#include "libprt/core/sampling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prt {
namespace {

/// Lights whose squared responses add up to the prior's.
std::vector<ShRgb> priorLights(int bands) {
  std::vector<ShRgb> lights;
  for (int l = 0; l < bands; ++l)
    for (int m = -l; m <= l; ++m) {
      ShRgb light(bands);
      light.c[std::size_t(shIndex(l, m))] = Rgb(1.0f / float(l + 1));
      lights.push_back(light);
    }
  return lights;
}

/// Irradiance under every light: [lights][points].
using Responses = std::vector<std::vector<Rgb>>;

Responses responses(const Transfer& transfer, std::span<const ShRgb> lights) {
  Responses all;
  for (const ShRgb& light : lights) all.push_back(irradiance(transfer, light, {}));
  return all;
}

/// What the points lie between: which samples, and which of them each point takes.
struct Surroundings {
  std::vector<std::uint32_t> samples;  // sorted
  std::vector<SamplePlace> places;     // [points] indices into samples

  Surroundings(const TriMesh& mesh, const SampleSet& surface, const SampleSet& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      SamplePlace& place = places.emplace_back();
      surface.at(mesh, points.triangle[i], points.barycentric[i], false, place);
      samples.insert(samples.end(), place.sample.begin(), place.sample.end());
    }
    std::sort(samples.begin(), samples.end());
    samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
    for (SamplePlace& place : places)
      for (std::uint32_t& s : place.sample)
        s = std::uint32_t(std::ranges::lower_bound(samples, s) - samples.begin());
  }
};

Rgb interpolate(const std::vector<Rgb>& values, const SamplePlace& place) {
  Rgb sum(0);
  for (std::size_t i = 0; i < 4; ++i) sum += place.weight[int(i)] * values[place.sample[i]];
  return sum;
}

/// Bakes sets of points independently of each other and of the product.
class PointBaker {
 public:
  PointBaker(std::shared_ptr<const Scene> scene, std::shared_ptr<const RayScene> rays,
             const SampleSet& surface, const Transfer& transfer, const TransferSettings& settings,
             const FloorOptions& options, Job& job)
      : scene_(std::move(scene)),
        rays_(std::move(rays)),
        surface_(surface),
        transfer_(transfer),
        settings_(settings),
        job_(job) {
    settings_.rays = std::min(settings.rays, options.maxRays);
    settings_.bounces = transfer.bounces;
    settings_.storage = DType::f32;
  }

  /// `half` 0 and 1 are independent estimates of the same. `buried`, if given, gets the marks.
  Transfer bake(const SampleSet& points, std::uint64_t half, std::uint64_t seed,
                std::vector<std::uint8_t>* buried = nullptr) {
    TransferSettings settings = settings_;
    settings.seed = hashBits(seed, half, 0x666c6f6fu);
    DirectSettings direct = directSettings(settings, TransferForm::Diffuse);
    direct.phase = "interpolation floor";
    DirectBake bake(scene_, rays_, std::make_shared<SampleSet>(points), direct);
    while (!bake.done()) bake.advance(job_);
    const DirectTransfer product = bake.product(job_);
    if (buried)
      *buried = {product.buried.as<std::uint8_t>().begin(), product.buried.as<std::uint8_t>().end()};
    return finishTransfer(*scene_, *rays_, points, product, settings, TransferForm::Diffuse, job_, &transfer_,
                          nullptr, &surface_);
  }

 private:
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const RayScene> rays_;
  const SampleSet& surface_;
  const Transfer& transfer_;
  TransferSettings settings_;
  Job& job_;
};

/// Mean squares by products of independent halves.
struct Squares {
  double truth = 0, interpolation = 0, product = 0;
  double interpolationSquared = 0;  // sum of squared per-point terms, for the standard error
  std::size_t points = 0;

  InterpolationFloor result() const {
    InterpolationFloor floor;
    floor.points = points;
    if (!(truth > 0) || points < 2) return floor;
    const auto n = double(points);
    floor.interpolation = std::sqrt(std::max(0.0, interpolation / truth));
    floor.product = std::sqrt(std::max(0.0, product / truth));
    floor.sampling = std::sqrt(std::max(0.0, (product - interpolation) / truth));
    const double variance = std::max(0.0, interpolationSquared / n - std::pow(interpolation / n, 2)) / n;
    const double errorOfSquare = std::sqrt(variance) / (truth / n);
    floor.interpolationError =
        floor.interpolation > 0 ? errorOfSquare / (2 * floor.interpolation) : std::sqrt(errorOfSquare);
    return floor;
  }
};

}  // namespace

InterpolationFloor measureInterpolationFloor(std::shared_ptr<const Scene> scene,
                                             std::shared_ptr<const RayScene> rays, const SampleSet& surface,
                                             const Transfer& transfer, const TransferSettings& settings,
                                             std::span<const ShRgb> lights, Job& job,
                                             const FloorOptions& options) {
  if (options.points < 16 || options.points > 100000 || options.maxRays < 1)
    throw ValueError("cannot measure the floor with " + std::to_string(options.points) + " points",
                     "interpolation floor", "use 16 to 100000 points and at least one ray");
  if (transfer.samples != surface.size() || !surface.coversSurface())
    throw ValueError("the transfer is not of these vertices or texels", "interpolation floor",
                     "bake samplesAtVertices() or samplesAtTexels() first");
  if (transfer.form == TransferForm::None) return {};
  const std::vector<ShRgb> prior = lights.empty() ? priorLights(transfer.bands) : std::vector<ShRgb>{};
  if (lights.empty()) lights = prior;

  // The truth at random points, and the samples around them, each twice with rays of their own.
  const SampleSet points = samplesOnSurface(*scene, options.points, options.seed);
  const Surroundings around(scene->mesh, surface, points);
  const SampleSet cornerSamples = someSamples(surface, around.samples);
  PointBaker baker(scene, rays, surface, transfer, settings, options, job);
  std::vector<std::uint8_t> buried, buriedCorner;
  const std::array<Responses, 2> truth{responses(baker.bake(points, 0, options.seed, &buried), lights),
                                       responses(baker.bake(points, 1, options.seed), lights)};
  const std::array<Responses, 2> corner{
      responses(baker.bake(cornerSamples, 0, options.seed + 1, &buriedCorner), lights),
      responses(baker.bake(cornerSamples, 1, options.seed + 1), lights)};
  Responses product;
  for (const ShRgb& light : lights)
    product.push_back(irradiance(transfer, light, surface.shadingNormal, around.samples));

  Squares squares;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SamplePlace& place = around.places[i];
    if (buried[i] || std::ranges::any_of(place.sample, [&](std::uint32_t s) { return buriedCorner[s] != 0; }))
      continue;
    double truthHere = 0, interpolationHere = 0, productHere = 0;
    for (std::size_t light = 0; light < lights.size(); ++light) {
      const auto between = [&](const std::vector<Rgb>& values) { return interpolate(values, place); };
      const Rgb r0 = truth[0][light][i], r1 = truth[1][light][i];
      truthHere += dot(DVec3(r0), DVec3(r1));
      interpolationHere += dot(DVec3(between(corner[0][light]) - r0), DVec3(between(corner[1][light]) - r1));
      productHere += dot(DVec3(between(product[light]) - r0), DVec3(between(product[light]) - r1));
    }
    squares.truth += truthHere, squares.interpolation += interpolationHere, squares.product += productHere;
    squares.interpolationSquared += interpolationHere * interpolationHere;
    ++squares.points;
  }
  return squares.result();
}

}  // namespace prt
