#include "libprt/study/biscale_truth.h"

#include "libprt/core/error.h"
#include "libprt/light/projection.h"
#include "libprt/meso/patch_generate.h"
#include "libprt/project/laid_patch.h"
#include "libprt/project/products.h"
#include "libprt/project/synthesis_stages.h"
#include "libprt/shade/biscale.h"
#include "libprt/shade/reference.h"
#include "libprt/shade/render.h"
#include "libprt/study/bench.h"

#include <chrono>
#include <cmath>

namespace prt {
namespace {

constexpr const char* kBuiltIn = "builtin:";

HeightGrid heightsOf(const PatchOptions& patch) {
  if (patch.model != PatchModel::HeightField || !patch.heightmap.starts_with(kBuiltIn))
    throw ValueError("is no built-in height field, and only those are displaced", "patch.model",
                     "set patch.model=heightfield and patch.heightmap=builtin:NAME");
  return generateHeights({patch.heightmap.substr(std::string(kBuiltIn).size()), patch.depth, patch.count,
                          std::uint32_t(patch.seed), patch.grid});
}

/// World length of one patch.
double patchWidthOf(const Recipe& recipe, const Products& products, const TriMesh& mesh) {
  if (const auto synthesis = products.get<SynthesisProduct>("synthesis");
      synthesis && synthesis->patchWidth > 0)
    return synthesis->patchWidth;
  const PatchRepeat repeat = squareRepeat(mesh, recipe.synthesis.repeat);
  double area = 0;
  for (std::size_t f = 0; f < mesh.triangleCount(); ++f) area += 0.5 * double(length(mesh.areaNormal(f)));
  return std::sqrt(area / (double(repeat.u) * repeat.v));
}

/// Means of blocks of grid x grid pixels.
Image shrunk(const Image& image, int grid) {
  Image out(image.width / grid, image.height / grid, image.channels);
  const float share = 1.0f / float(grid * grid);
  for (int y = 0; y < out.height * grid; ++y)
    for (int x = 0; x < out.width * grid; ++x)
      for (int c = 0; c < image.channels; ++c)
        out.pixel(x / grid, y / grid)[c] += share * image.pixel(x, y)[c];
  return out;
}

Image meanOf(const Image& a, const Image& b) {
  Image mean = a;
  for (std::size_t i = 0; i < mean.data.size(); ++i) mean.data[i] = 0.5f * (a.data[i] + b.data[i]);
  return mean;
}

}  // namespace

BiscaleTruth::BiscaleTruth(const TruthCase& of, Job& job) : case_(of) {
  Pipeline pipeline(nullptr, {});
  products_ = pipeline.run(case_.recipe, stagesOfPicture(case_.recipe), job);
  surface_ = laidPatch(products_, case_.recipe);
  displace(job);
  trace(job);
  draw(job);
}

Image BiscaleTruth::reference() const {
  return meanOf(references_[0], references_[1]);
}

void BiscaleTruth::displace(Job& job) {
  const PatchOptions& patch = case_.recipe.patch;
  const TriMesh& mesh = surface_->scene->mesh;
  SceneObject object;
  object.mesh = std::make_shared<TriMesh>(displacedSurface(
      *surface_, heightsOf(patch), {patchWidthOf(case_.recipe, products_, mesh), case_.cuts}, job));
  object.material.albedo = patch.albedo;
  displaced_ = std::make_shared<Scene>(flattenScene(std::span(&object, 1)));
}

void BiscaleTruth::trace(Job& job) {
  LightRig rig;
  rig.environment = std::make_shared<EnvironmentMap>(bandLimitedMap(case_.light, 512, 256));
  const PathTracer tracer(*displaced_, rig, job);
  const double pixels = double(case_.width) * case_.height;
  double noise = 0, seconds = 0;
  for (int i = 0; i < 2; ++i) {
    ReferenceImage image(tracer, case_.camera, case_.width, case_.height,
                         {.bounces = case_.recipe.transfer.bounces, .seed = std::uint64_t(i) + 1});
    const auto begun = std::chrono::steady_clock::now();
    image.add(case_.paths, job);
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    references_[i] = image.radiance();
  }
  // Two independent means of n paths differ by twice the variance of one mean: that of n / 2.
  for (std::size_t i = 0; i < references_[0].data.size(); ++i) {
    if (i % 4 == 3) continue;
    const double d = double(references_[0].data[i]) - double(references_[1].data[i]);
    noise += d * d;
  }
  noise_ = noise / (3 * pixels) * 0.5 * case_.paths;
  secondsPerPath_ = seconds / (2.0 * case_.paths * pixels);
}

void BiscaleTruth::draw(Job& job) {
  const SampleSet& samples = *products_.get<SamplesProduct>("samples")->samples;
  const Transfer& transfer = products_.get<TransferProduct>("transfer")->transfer;
  Transfer unshadowed;
  unshadowed.bands = transfer.bands;
  const ShRgb light = case_.light;
  Scene matte = *surface_->scene;
  for (Material& material : matte.materials)
    material = Material{}, material.albedo = case_.recipe.patch.albedo;
  // A renderer shades a triangle once in a pixel, and the patch is finer than both: every sample is a pixel.
  const int width = case_.width * case_.grid, height = case_.height * case_.grid;
  const auto picture = [&](bool macro, bool meso) {
    const Transfer& used = macro ? transfer : unshadowed;
    const Image fine = meso ? renderBiscale({*surface_, samples, used, light, nullptr, true}, case_.camera,
                                            width, height, 1, job)
                            : render({matte, samples, used, light, ShadeMethod::Diffuse, {}, nullptr},
                                     case_.camera, width, height, 1, job);
    return shrunk(fine, case_.grid);
  };
  const PixelMask mask = coveredPixels(reference());
  pictures_ = {{"both scales", true, true},
               {"macro scale alone", true, false},
               {"meso scale alone", false, true},
               {"neither", false, false}};
  for (TruthPicture& p : pictures_) {
    p.picture = picture(p.macro, p.meso);
    p.error =
        noiseFreeError(p.picture, references_[0], references_[1], bothMasks(mask, coveredPixels(p.picture)));
  }
}

}  // namespace prt
