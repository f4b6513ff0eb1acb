#include "libprt/gl/scene_renderer.h"

#include "libprt/core/error.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <vector>

namespace prt::gl {

namespace {

constexpr unsigned kMaterialBinding = 0;
constexpr int kEnvironmentUnit = 0, kManySamplesUnit = 1, kOneSampleUnit = 2;

// As shaders/material.glsl has it.
struct GpuMaterial {
  Vec4 albedo;
  Vec4 specular;
};

// Distances that hold the whole box, seen from the eye; never nearer than a thousandth of it.
Vec2 depthRange(const Camera& camera, const Box3& box) {
  const float radius = std::max(0.5f * box.diagonal(), 1e-6f);
  const Vec3 forward = camera.target - camera.eye;
  const float middle = dot(box.center() - camera.eye, length(forward) > 0 ? normalize(forward) : Vec3(0, 0, -1));
  const float farPlane = std::max(middle + 1.01f * radius, 2e-3f * radius);
  return {std::max(middle - 1.01f * radius, 1e-3f * radius), farPlane};
}

int supportedSamples(int wanted) {
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  return std::clamp(wanted, 1, std::max(1, int(most)));
}

}  // namespace

SceneRenderer::SceneRenderer()
    : meshProgram_(Program::fromLibrary("mesh.vert", "mesh.frag")),
      backgroundProgram_(Program::fromLibrary("fullscreen.vert", "background.frag")),
      toneProgram_(Program::fromLibrary("fullscreen.vert", "tone.frag")),
      meshArray_(VertexArray::create()),
      emptyArray_(VertexArray::create()),
      positions_(Buffer::create()),
      normals_(Buffer::create()),
      irradiance_(Buffer::create()),
      objects_(Buffer::create()),
      indices_(Buffer::create()),
      materials_(Buffer::create()) {
  backgroundProgram_.set("environment", kEnvironmentUnit);
  toneProgram_.set("manySamples", kManySamplesUnit);
  toneProgram_.set("oneSample", kOneSampleUnit);
  checkErrors("start of the GL renderer");
}

void SceneRenderer::setScene(const Scene& scene) {
  const TriMesh& mesh = scene.mesh;
  vertexCount_ = int(mesh.vertexCount());
  indexCount_ = int(3 * mesh.triangleCount());
  bounds_ = mesh.bounds();
  positions_.upload(std::span<const Vec3>(mesh.positions));
  normals_.upload(std::span<const Vec3>(mesh.normals));
  objects_.upload(std::span<const std::uint32_t>(scene.vertexObject));
  indices_.upload(std::span<const UVec3>(mesh.triangles));
  setIrradiance(std::vector<Rgb>(mesh.vertexCount(), Rgb(0)));
  setMaterials(scene.materials);

  meshArray_.floats(0, positions_, 3);
  meshArray_.floats(1, normals_, 3);
  meshArray_.floats(2, irradiance_, 3);
  meshArray_.integers(3, objects_);
  meshArray_.indices(indices_);
  checkErrors("upload of the scene");
}

void SceneRenderer::setMaterials(std::span<const Material> materials) {
  std::vector<GpuMaterial> packed;
  for (const Material& m : materials)
    packed.push_back({Vec4(m.albedo, m.twoSided ? 1 : 0), Vec4(m.glossy() ? m.specular : Rgb(0), m.exponent)});
  materials_.upload(std::span<const GpuMaterial>(packed));
}

void SceneRenderer::setIrradiance(std::span<const Rgb> irradiance) {
  if (int(irradiance.size()) != vertexCount_)
    throw ValueError("irradiance of " + std::to_string(irradiance.size()) + " vertices for a mesh of " +
                         std::to_string(vertexCount_), "GL renderer", "set the scene first");
  irradiance_.upload(irradiance);
}

void SceneRenderer::setEnvironment(const Image& latLong) {
  environment_ = Texture::fromImage(latLong, Wrap::RepeatX, false);
  checkErrors("upload of the environment");
}

void SceneRenderer::draw(const Picture& picture, unsigned framebuffer) {
  const int samples = supportedSamples(picture.samples);
  drawRadiance(picture, PixelFormat::Rgba16f, samples);

  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, picture.width, picture.height);
  radiance_.colour().bind(samples > 1 ? kManySamplesUnit : kOneSampleUnit);
  toneProgram_.set("samples", samples);
  toneProgram_.set("exposure", picture.exposure);
  toneProgram_.use();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glBindVertexArray(emptyArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glUseProgram(0);
  checkErrors("drawing");
}

Image SceneRenderer::render(const Picture& picture) {
  const int samples = supportedSamples(picture.samples);
  drawRadiance(picture, PixelFormat::Rgba32f, samples);
  if (samples == 1) return radiance_.read();
  const Framebuffer resolved = Framebuffer::create(picture.width, picture.height, PixelFormat::Rgba32f, false);
  glBlitNamedFramebuffer(radiance_.id(), resolved.id(), 0, 0, picture.width, picture.height, 0, 0, picture.width,
                         picture.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  checkErrors("drawing");
  return resolved.read();
}

Image SceneRenderer::renderToned(const Picture& picture) {
  const Framebuffer target = Framebuffer::create(picture.width, picture.height, PixelFormat::Rgba32f, false);
  draw(picture, target.id());
  return target.read();
}

void SceneRenderer::drawRadiance(const Picture& picture, PixelFormat format, int samples) {
  if (!radiance_ || radiance_.width() != picture.width || radiance_.height() != picture.height ||
      radiance_.samples() != samples || radianceFormat_ != format) {
    radiance_ = Framebuffer::create(picture.width, picture.height, format, true, samples);
    radianceFormat_ = format;
  }
  radiance_.bind();
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(0, 0, 0, 0);
  glClearDepth(1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  if (indexCount_ > 0) drawMesh(picture);
  if (picture.background == Background::Environment && environment_) drawBackground(picture);
}

void SceneRenderer::drawMesh(const Picture& picture) {
  const Vec2 depth = depthRange(picture.camera, bounds_);
  const float aspect = float(picture.width) / float(picture.height);
  meshProgram_.set("worldToClip", picture.camera.projection(aspect, depth.x, depth.y) * picture.camera.view());
  meshProgram_.use();
  materials_.bindStorage(kMaterialBinding);
  glBindVertexArray(meshArray_.id());
  glDrawElements(GL_TRIANGLES, indexCount_, GL_UNSIGNED_INT, nullptr);
}

// Behind everything: the triangle lies on the far plane and passes where nothing nearer was drawn.
void SceneRenderer::drawBackground(const Picture& picture) {
  const auto direction = [&](float x, float y) {
    return picture.camera.direction(x * picture.width, y * picture.height, picture.width, picture.height);
  };
  // Directions on the image plane, at distance 1 along the optical axis.
  const Vec3 forward = direction(0.5f, 0.5f);
  const auto onPlane = [&](float x, float y) {
    const Vec3 d = direction(x, y);
    return d / dot(d, forward);
  };
  const Vec3 corner = onPlane(0, 1);
  environment_.bind(kEnvironmentUnit);
  backgroundProgram_.set("corner", corner);
  backgroundProgram_.set("right", onPlane(1, 1) - corner);
  backgroundProgram_.set("up", onPlane(0, 0) - corner);
  backgroundProgram_.set("rotation", picture.environmentRotation);
  backgroundProgram_.set("alpha", 1.0f);
  backgroundProgram_.use();
  glBindVertexArray(emptyArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace prt::gl
