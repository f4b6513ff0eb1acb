#include "libprt/gl/biscale_pass.h"

#include "libprt/shade/biscale.h"

#include <epoxy/gl.h>

#include <array>
#include <numeric>
#include <vector>

namespace prt::gl {

namespace {

constexpr unsigned kCornerBinding = 1, kPositionBinding = 2, kNormalBinding = 3, kTangentBinding = 4,
                   kCoordinateBinding = 5;
constexpr unsigned kLightUnit = 0, kResponseUnit = 1, kIdUnit = 2;

}  // namespace

BiscalePass::BiscalePass()
    : program_(Program::fromLibrary("biscale.vert", "biscale.frag")),
      array_(VertexArray::create()),
      light_(BufferTexture::create(BufferTexture::Format::Floats)),
      responses_(BufferTexture::create(BufferTexture::Format::Integers)) {
  for (Buffer* buffer : {&positions_, &normals_, &tangents_, &corners_, &coordinates_})
    *buffer = Buffer::create();
  program_.set("light", int(kLightUnit));
  program_.set("responses", int(kResponseUnit));
  program_.set("ids", int(kIdUnit));
  checkErrors("start of the bi-scale pass");
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
  const ResponseTable& responses = *surface->responses;
  program_.set("side", responses.texels());
  program_.set("viewSide", responses.views().side());
  program_.set("channels", responses.channels());
  program_.set("groups", int(responses.padded() / 8));
  program_.set("patchColour", responses.colour());
  const std::vector<float> black(surface->shading.size() * 3 * responses.padded(), 0.0f);
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
  ids_ = cover.map() ? Texture::fromPairs(cover.map()->ids, cover.map()->size, cover.map()->size)
                     : Texture::fromPairs(kNone, 1, 1);
  program_.set("mapSize", cover.map() ? cover.map()->size : 0);
}

void BiscalePass::setLight(const SampleSet& samples, const Transfer& transfer, const ShRgb& light, Job& job) {
  if (!surface_) return;
  std::vector<std::uint32_t> frames(surface_->shading.size());
  std::iota(frames.begin(), frames.end(), 0u);
  light_.upload(BiscaleLight(*surface_, frames, samples, transfer, light, job).records(),
                "light on the patch");
  checkErrors("upload of light on the patch");
}

void BiscalePass::draw(const SurfaceView& view, bool viewDependent) {
  if (!surface_) return;
  program_.set("worldToClip", view.worldToClip);
  program_.set("viewer", view.viewer);
  program_.set("viewDependent", viewDependent ? 1 : 0);
  corners_.bindStorage(kCornerBinding);
  positions_.bindStorage(kPositionBinding);
  normals_.bindStorage(kNormalBinding);
  tangents_.bindStorage(kTangentBinding);
  coordinates_.bindStorage(kCoordinateBinding);
  light_.bind(kLightUnit);
  responses_.bind(kResponseUnit);
  ids_.bind(kIdUnit);
  program_.use();
  glBindVertexArray(array_.id());
  glDrawElements(GL_TRIANGLES, indexCount_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace prt::gl
