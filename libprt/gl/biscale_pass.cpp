#include "libprt/gl/biscale_pass.h"

#include "libprt/shade/biscale.h"

#include <epoxy/gl.h>

#include <array>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace prt::gl {

namespace {

constexpr unsigned kPlainBinding = 0, kCornerBinding = 1, kPositionBinding = 2, kNormalBinding = 3,
                   kTangentBinding = 4, kCoordinateBinding = 5, kRectangleBinding = 6, kChartBinding = 7;
constexpr unsigned kLightUnit = 0, kResponseUnit = 1, kIdUnit = 2, kCoefficientUnit = 3, kTermUnit = 4,
                   kOwnerUnit = 5, kPlainUnit = 6, kLayerUnit = 7;

Program programWith(const std::string& prelude) {
  Program program = Program::fromLibrary("biscale.vert", "biscale.frag", prelude);
  program.set("light", int(kLightUnit));
  program.set("responses", int(kResponseUnit));
  program.set("ids", int(kIdUnit));
  program.set("coefficients", int(kCoefficientUnit));
  program.set("terms", int(kTermUnit));
  program.set("owners", int(kOwnerUnit));
  program.set("plainResponses", int(kPlainUnit));
  program.set("layerWeights", int(kLayerUnit));
  return program;
}

/// Three channels for every texel of the id map.
Texture weightsTexture(const IdMap& map) {
  const auto layers = std::size_t(map.layers);
  std::vector<std::uint8_t> channels(map.ids.size() / 2 * 4, 0);
  for (std::size_t i = 0; i < map.ids.size() / 2; ++i)
    for (std::size_t k = 0; k < layers; ++k) channels[4 * i + k] = map.weights[layers * i + k];
  return Texture::fromBytes(channels, map.size, map.size);
}

}  // namespace

BiscalePass::BiscalePass()
    : array_(VertexArray::create()),
      light_(BufferTexture::create(BufferTexture::Format::Floats)),
      responses_(BufferTexture::create(BufferTexture::Format::Integers)),
      plainResponses_(BufferTexture::create(BufferTexture::Format::Integers)),
      coefficients_(BufferTexture::create(BufferTexture::Format::Integers)),
      terms_(BufferTexture::create(BufferTexture::Format::Integers)) {
  for (Buffer* buffer :
       {&positions_, &normals_, &tangents_, &corners_, &coordinates_, &rectangles_, &charts_, &plainTexels_})
    *buffer = Buffer::create();
  programs_[0] = programWith({});
  checkErrors("start of the bi-scale pass");
}

Program& BiscalePass::program() {
  const bool filter = surface_->filter != nullptr, layers = surface_->cover->layers() > 1;
  Program& program = programs_[std::size_t(filter) + 2 * std::size_t(layers)];
  if (!program)
    program = programWith(std::string(filter ? "#define FILTER\n" : "") + (layers ? "#define LAYERS\n" : ""));
  return program;
}

void BiscalePass::setSurface(std::shared_ptr<const BiscaleSurface> surface) {
  if (surface == surface_) return;
  const auto before = std::exchange(surface_, nullptr);
  if (!surface) return;
  if (!before || surface->scene != before->scene || surface->frames != before->frames)
    uploadGeometry(*surface);
  if (!before || surface->cover != before->cover) uploadCover(*surface->cover);
  if (!before || surface->responses != before->responses)
    responses_.upload(surface->responses->halfs(), "radiance transfer texture");
  if (surface->filter && (!before || surface->filter != before->filter)) uploadFilter(*surface->filter);
  if (!before || surface->scene != before->scene || surface->plain != before->plain) uploadPlain(*surface);
  const bool sameFrames = before && surface->scene == before->scene && surface->frames == before->frames &&
                          surface->responses->padded() == before->responses->padded();
  if (transfer_ && !sameFrames) transfer_->forget();
  const std::vector<float> black(surface->shading.size() * 3 * surface->responses->padded(), 0.0f);
  light_.upload(std::span<const float>(black), "light on the patch");
  checkErrors("upload of the patch");
  surface_ = std::move(surface);
}

// One vertex for every frame; see ShadingFrames.
void BiscalePass::uploadGeometry(const BiscaleSurface& surface) {
  const TriMesh& mesh = surface.scene->mesh;
  std::vector<Vec3> positions, normals;
  for (const std::uint32_t v : surface.shading.vertex) {
    positions.push_back(mesh.positions[v]);
    normals.push_back(mesh.normals[v]);
  }
  bounds_ = mesh.bounds();
  indexCount_ = int(surface.shading.corner.size());
  positions_.upload(std::span<const Vec3>(positions));
  normals_.upload(std::span<const Vec3>(normals));
  tangents_.upload(std::span<const Vec3>(surface.frames->tangents));
  corners_.upload(std::span<const std::uint32_t>(surface.shading.corner));
  array_.floats(0, positions_, 3);
  array_.indices(corners_);
}

void BiscalePass::uploadCover(const PatchCover& cover) {
  const std::vector<Vec2> coordinates = cover.cornerCoordinates();
  coordinates_.upload(std::span<const Vec2>(coordinates));
  static constexpr std::array<std::uint16_t, 2> kNone{};
  ids_ = cover.map() ? Texture::fromIntegers(cover.map()->ids, 2, cover.map()->size, cover.map()->size)
                     : Texture::fromIntegers(kNone, 2, 1, 1);
  if (cover.layers() > 1) layerWeights_ = weightsTexture(*cover.map());
}

void BiscalePass::uploadFilter(const PatchFilter& filter) {
  coefficients_.upload(filter.coefficients(), "filtered patch");
  terms_.upload(filter.terms().halfs(), "terms of the patch");
  rectangles_.upload(filter.rectangles());
  charts_.upload(filter.charts());
  static constexpr std::array<std::uint16_t, 1> kNone{};
  owners_ = filter.repeats() ? Texture::fromIntegers(kNone, 1, 1, 1)
                             : Texture::fromIntegers(filter.owners(), 1, filter.size(), filter.size());
}

void BiscalePass::uploadPlain(const BiscaleSurface& surface) {
  if (surface.plain) {
    plainTexels_.upload(surface.plain->texels());
    plainResponses_.upload(surface.plain->responses().halfs(), "materials beside the patch");
  } else {
    const std::vector<std::uint32_t> none(surface.scene->mesh.triangleCount(), PlainObjects::kPatched);
    plainTexels_.upload(std::span<const std::uint32_t>(none));
    static constexpr std::array<std::uint16_t, 8> kNothing{};
    plainResponses_.upload(std::span<const std::uint16_t>(kNothing), "materials beside the patch");
  }
}

void BiscalePass::setLight(const SampleSet& samples, const Transfer& transfer, const ShRgb& light, Job& job) {
  if (!surface_) return;
  std::vector<std::uint32_t> frames(surface_->shading.size());
  std::iota(frames.begin(), frames.end(), 0u);
  light_.upload(BiscaleLight(*surface_, frames, samples, transfer, light, job).records(),
                "light on the patch");
  checkErrors("upload of light on the patch");
}

bool BiscalePass::keepTransfer(const TurnedTransfer& turned) {
  if (transfer_) transfer_->forget();
  if (!surface_ || turned.empty() || turned.frames != surface_->shading.size() ||
      turned.padded != surface_->responses->padded())
    return false;
  if (!transfer_) transfer_.emplace();
  transfer_->upload(turned);
  return true;
}

void BiscalePass::setLight(const ShRgb& light) {
  if (surface_ && transfer_ && !transfer_->empty()) transfer_->apply(light, light_);
}

void BiscalePass::draw(const SurfaceView& view, bool viewDependent) {
  if (!surface_) return;
  Program& program = this->program();
  const ResponseTable& responses = *surface_->responses;
  program.set("side", responses.texels());
  program.set("viewSide", responses.views().side());
  program.set("channels", responses.channels());
  program.set("groups", int(responses.padded() / 8));
  program.set("patchColour", responses.colour());
  program.set("plainViewSide", surface_->plain ? surface_->plain->responses().views().side() : 1);
  program.set("mapSize", surface_->cover->map() ? surface_->cover->map()->size : 0);
  program.set("worldToClip", view.worldToClip);
  program.set("viewer", view.steps.viewer);
  program.set("viewDependent", viewDependent ? 1 : 0);
  if (surface_->filter) {
    program.set("forward", view.steps.forward);
    program.set("pixelRight", view.steps.right);
    program.set("pixelDown", view.steps.down);
    program.set("termCount", PatchFilter::kTerms);
    program.set("levels", surface_->filter->levels());
    program.set("scales", surface_->filter->scales());
    rectangles_.bindStorage(kRectangleBinding);
    charts_.bindStorage(kChartBinding);
    coefficients_.bind(kCoefficientUnit);
    terms_.bind(kTermUnit);
    owners_.bind(kOwnerUnit);
  }
  plainTexels_.bindStorage(kPlainBinding);
  corners_.bindStorage(kCornerBinding);
  positions_.bindStorage(kPositionBinding);
  normals_.bindStorage(kNormalBinding);
  tangents_.bindStorage(kTangentBinding);
  coordinates_.bindStorage(kCoordinateBinding);
  light_.bind(kLightUnit);
  responses_.bind(kResponseUnit);
  plainResponses_.bind(kPlainUnit);
  ids_.bind(kIdUnit);
  if (surface_->cover->layers() > 1) layerWeights_.bind(kLayerUnit);
  program.use();
  glBindVertexArray(array_.id());
  glDrawElements(GL_TRIANGLES, indexCount_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace prt::gl
