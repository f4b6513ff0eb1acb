#include "libprt/gl/scene_renderer.h"

#include "libprt/core/warp.h"
#include "libprt/light/resample.h"
#include "libprt/shade/ground_grid.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace prt::gl {

namespace {

constexpr unsigned kCircleBinding = 6;
constexpr int kEnvironmentUnit = 0, kManySamplesUnit = 1, kOneSampleUnit = 2, kManyDepthsUnit = 3,
              kOneDepthUnit = 4;
constexpr int kLatLongWidth = 2048;  // of environments that come in another mapping

// As shaders/background.frag has it.
struct GpuCircle {
  Vec4 axis;      // and 1 - cosine of the rim
  Vec4 radiance;  // and sine of the rim
};
constexpr float kSmallestRim = 1e-4f;  // sine; a light of 180 degrees has none

// Number `index` of the van der Corput sequence in a base, 0..1.
float vanDerCorput(int index, int base) {
  float value = 0, place = 1;
  for (; index > 0; index /= base) value += float(index % base) * (place /= float(base));
  return value;
}
}  // namespace

Vec2 passShift(int pass) {
  return pass == 0 ? Vec2(0) : Vec2(vanDerCorput(pass, 2) - 0.5f, vanDerCorput(pass, 3) - 0.5f);
}
SceneRenderer::SceneRenderer()
    : backgroundProgram_(Program::fromLibrary("fullscreen.vert", "background.frag")),
      toneProgram_(Program::fromLibrary("fullscreen.vert", "tone.frag")),
      meanProgram_(Program::fromLibrary("fullscreen.vert", "mean.frag")),
      emptyArray_(VertexArray::create()),
      circles_(Buffer::create()) {
  noEnvironment_ = Texture::fromImage(Image(1, 1, 3), Wrap::RepeatX, false);  // black
  backgroundProgram_.set("environment", kEnvironmentUnit);
  toneProgram_.set("manySamples", kManySamplesUnit);
  toneProgram_.set("oneSample", kOneSampleUnit);
  toneProgram_.set("manyDepths", kManyDepthsUnit);
  toneProgram_.set("oneDepth", kOneDepthUnit);
  meanProgram_.set("sum", kOneSampleUnit);
  checkErrors("start of the GL renderer");
}

void SceneRenderer::setScene(const Scene& scene, std::span<const std::uint32_t> back) {
  mesh_.setScene(scene, back, nullptr);
}

void SceneRenderer::setScene(const Scene& scene, const SampleSet& samples) {
  mesh_.setScene(scene, samples.back, samples.texels.get());
}

void SceneRenderer::setMaterials(std::span<const Material> materials) {
  mesh_.setMaterials(materials);
}

void SceneRenderer::setLight(const SurfaceLight& light) {
  mesh_.setLight(light);
}

void SceneRenderer::setIrradiance(std::span<const Rgb> irradiance) {
  mesh_.setIrradiance(irradiance);
}

void SceneRenderer::setRadiance(int bands, std::span<const Rgb> coefficients, std::span<const Rgb> beyond) {
  mesh_.setRadiance(bands, coefficients, beyond);
}

void SceneRenderer::setLight(const ShRgb& light) {
  mesh_.setLight(light);
}

void SceneRenderer::setPatch(std::shared_ptr<const BiscaleSurface> patch) {
  if (patch && !patch_) patch_.emplace();
  if (patch_) patch_->setSurface(std::move(patch));
}

void SceneRenderer::setPatchLight(const SampleSet& samples, const Transfer& transfer, const ShRgb& light,
                                  Job& job) {
  if (patch_) patch_->setLight(samples, transfer, light, job);
}

bool SceneRenderer::keepPatchTransfer(const TurnedTransfer& turned) {
  return patch_ && patch_->keepTransfer(turned);
}

void SceneRenderer::setPatchLight(const ShRgb& light) {
  if (patch_) patch_->setLight(light);
}

void SceneRenderer::setSurroundings(const Surroundings& surroundings) {
  if (!surroundings.empty()) {
    if (!around_) around_.emplace();
    if (aroundScene_ != surroundings.scene)
      around_->setScene(*surroundings.scene, surroundings.samples->back, nullptr);
    around_->setEmission(surroundings.emission);
    around_->setLight(surroundings.light);
  }
  aroundScene_ = surroundings.scene;
}

void SceneRenderer::setEnvironment(const EnvironmentMap& map) {
  const bool latLong = map.report().mapping == EnvironmentMapping::LatLong;
  environment_ =
      Texture::fromImage(latLong ? map.pixels() : toLatLong(map, kLatLongWidth, kLatLongWidth / 2).pixels(),
                         Wrap::RepeatX, false);
  checkErrors("upload of the environment");
}

void SceneRenderer::draw(const Picture& picture, unsigned framebuffer) {
  const int samples = supportedSamples(picture.samples);
  drawRadiance(picture, PixelFormat::Rgba16f, samples);

  // Passes are summed as the screen shows them, so that edges against bright light get smooth too.
  if (!passes_ || passes_.width() != picture.width || passes_.height() != picture.height)
    passes_ = Framebuffer::create(picture.width, picture.height, PixelFormat::Rgba16f, false);
  passes_.bind();
  glDisable(GL_DEPTH_TEST);
  if (picture.pass > 0) {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
  }
  drawToned(picture, samples);
  glDisable(GL_BLEND);
  passCount_ = picture.pass + 1;
  showAgain(framebuffer);
}

void SceneRenderer::showAgain(unsigned framebuffer) {
  if (!passes_) return;
  glDisable(GL_DEPTH_TEST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, passes_.width(), passes_.height());
  glBindVertexArray(emptyArray_.id());
  passes_.colour().bind(kOneSampleUnit);
  meanProgram_.set("count", float(passCount_));
  meanProgram_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glUseProgram(0);
  checkErrors("drawing");
}

void SceneRenderer::drawToned(const Picture& picture, int samples) {
  radiance_.colour().bind(samples > 1 ? kManySamplesUnit : kOneSampleUnit);
  toneProgram_.set("samples", samples);
  toneProgram_.set("exposure", picture.tone.exposure);
  toneProgram_.set("filmic", picture.tone.curve == ToneCurve::Filmic ? 1 : 0);
  toneProgram_.set("behind", picture.behind);
  toneProgram_.set("gridSpacing", picture.gridSpacing);
  if (picture.gridSpacing > 0) {
    radiance_.depth().bind(samples > 1 ? kManyDepthsUnit : kOneDepthUnit);
    const GridRays rays(picture.camera, picture.width, picture.height);
    const Vec3 origin[] = {rays.origin, rays.originRight, rays.originDown},
               direction[] = {rays.direction, rays.directionRight, rays.directionDown};
    const Vec2 shift = passShift(picture.pass);
    toneProgram_.set("gridParallel", picture.camera.orthographic ? 1 : 0);
    toneProgram_.set("gridOrigin", std::span<const Vec3>(origin));
    toneProgram_.set("gridDirection", std::span<const Vec3>(direction));
    toneProgram_.set("place", Vec2(shift.x, float(picture.height) - shift.y));
  }
  toneProgram_.use();
  glBindVertexArray(emptyArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Image SceneRenderer::render(const Picture& picture) {
  const int samples = supportedSamples(picture.samples);
  drawRadiance(picture, PixelFormat::Rgba32f, samples);
  if (samples == 1) return radiance_.read();
  const Framebuffer resolved =
      Framebuffer::create(picture.width, picture.height, PixelFormat::Rgba32f, false);
  glBlitNamedFramebuffer(radiance_.id(), resolved.id(), 0, 0, picture.width, picture.height, 0, 0,
                         picture.width, picture.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
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
  beginSurfaces();
  drawSurface(picture);
  const bool any = environment_ || !picture.circles.empty() || picture.constant != Rgb(0);
  if (picture.background == Background::Environment && any) drawBackground(picture);
}

// All in one range of depths, so that the nearer one is seen.
void SceneRenderer::drawSurface(const Picture& picture) {
  const bool patch = patch_ && !patch_->empty(), around = around_ && aroundScene_;
  Box3 bounds = patch ? patch_->bounds() : mesh_.empty() ? Box3{} : mesh_.bounds();
  if (around) bounds.extend(around_->bounds().low), bounds.extend(around_->bounds().high);
  const SurfaceView view =
      surfaceView(picture.camera, bounds, picture.width, picture.height, passShift(picture.pass));
  if (patch)
    patch_->draw(view, picture.viewDependent);
  else if (!mesh_.empty())
    mesh_.draw(view);
  if (around) around_->draw(view);
}

// Behind everything: the triangle lies on the far plane and passes where nothing nearer was drawn.
void SceneRenderer::drawBackground(const Picture& picture) {
  const CameraRays rays(picture.camera, picture.width, picture.height);
  const Vec2 shift = passShift(picture.pass);
  const auto onPlane = [&](float x, float y) {
    return rays.background(x * float(picture.width) + shift.x, y * float(picture.height) - shift.y);
  };
  const Vec3 corner = onPlane(0, 1);
  std::vector<GpuCircle> circles;
  for (const CircleLight& light : picture.circles)
    circles.push_back({Vec4(light.direction, coneHeight(light.halfAngle)),
                       Vec4(light.radiance, std::max(std::sin(light.halfAngle), kSmallestRim))});
  circles_.upload(std::span<const GpuCircle>(circles), sizeof(GpuCircle));  // bound even when it is empty
  circles_.bindStorage(kCircleBinding);
  (environment_ ? environment_ : noEnvironment_).bind(kEnvironmentUnit);
  const Vec3 right = onPlane(1, 1) - corner;
  backgroundProgram_.set("circleCount", int(circles.size()));
  backgroundProgram_.set("constant", picture.constant);
  backgroundProgram_.set("pixel", length(right) / float(picture.width));
  backgroundProgram_.set("corner", corner);
  backgroundProgram_.set("right", right);
  backgroundProgram_.set("up", onPlane(0, 0) - corner);
  backgroundProgram_.set("rotation", picture.environmentRotation);
  backgroundProgram_.set("intensity", picture.environmentIntensity);
  backgroundProgram_.set("smoothTexels", picture.smoothEnvironment ? 1 : 0);
  backgroundProgram_.use();
  glBindVertexArray(emptyArray_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace prt::gl
