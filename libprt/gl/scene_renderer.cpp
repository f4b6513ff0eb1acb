#include "libprt/gl/scene_renderer.h"

#include "libprt/core/error.h"
#include "libprt/core/warp.h"
#include "libprt/gl/sh_glsl.h"
#include "libprt/light/resample.h"
#include "libprt/material/glossy_response.h"
#include "libprt/shade/ground_grid.h"

#include <epoxy/gl.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace prt::gl {

namespace {

constexpr unsigned kMaterialBinding = 0, kCornerBinding = 1, kPositionBinding = 2, kRadianceBinding = 3,
                   kBehindBinding = 4, kResponseBinding = 5, kCircleBinding = 6, kColourBinding = 7,
                   kTexelBinding = 8;
constexpr int kEnvironmentUnit = 0, kManySamplesUnit = 1, kOneSampleUnit = 2, kManyDepthsUnit = 3,
              kOneDepthUnit = 4;
constexpr int kResponseRows = 512;  // view angles in a table of responses
constexpr int kMaxBands = 10;
constexpr int kLatLongWidth = 2048;  // of environments that come in another mapping

// As shaders/material.glsl has it.
struct GpuMaterial {
  Vec4 albedo;
  Vec4 specular;
};

// As shaders/background.frag has it.
struct GpuCircle {
  Vec4 axis;      // and 1 - cosine of the rim
  Vec4 radiance;  // and sine of the rim
};
constexpr float kSmallestRim = 1e-4f;  // sine; a light of 180 degrees has none

// Distances that hold the whole box, seen from the eye; never nearer than a thousandth of it.
Vec2 depthRange(const Camera& camera, const Box3& box) {
  const float radius = std::max(0.5f * box.diagonal(), 1e-6f);
  const Vec3 forward = camera.target - camera.eye;
  const float middle =
      dot(box.center() - camera.eye, length(forward) > 0 ? normalize(forward) : Vec3(0, 0, -1));
  if (camera.orthographic) return {middle - 1.01f * radius, middle + 1.01f * radius};
  const float farPlane = std::max(middle + 1.01f * radius, 2e-3f * radius);
  return {std::max(middle - 1.01f * radius, 1e-3f * radius), farPlane};
}

void expectSamples(std::size_t given, std::size_t wanted) {
  if (given == wanted) return;
  throw ValueError(
      "light of " + std::to_string(given) + " values for a scene that takes " + std::to_string(wanted),
      "GL renderer", "set the scene first");
}

// View angle of a table's row; denser towards the horizon, as response.glsl looks them up.
float responseAngle(int row) {
  const float away = 1 - float(row) / float(kResponseRows - 1);
  return 0.5f * kPiF * (1 - away * away);
}

// One table as shaders/response.glsl reads it.
void appendResponse(const GlossyResponse& response, std::vector<std::uint32_t>& tables) {
  const int bands = response.bands();
  std::vector<float> weights(std::size_t(shCount(bands)));
  for (int row = 0; row < kResponseRows; ++row) {
    response.weightsAt(responseAngle(row), weights);
    const auto weight = [&](int lobe, int l) {
      return l < bands ? weights[std::size_t(l * bands + lobe)] : 0.0f;
    };
    for (int lobe = 0; lobe < bands; ++lobe)
      for (int l = 0; l < bands; l += 2)
        tables.push_back(glm::packHalf2x16(Vec2(weight(lobe, l), weight(lobe, l + 1))));
  }
}

// Whether the coefficients can be handed from the vertex to the fragment shader, beside position, normal,
// two colours and the object.
bool fitsBetweenStages(int bands) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_VARYING_COMPONENTS, &most);
  return 4 * ((3 * shCount(bands) + 3) / 4 + 5) <= most;
}

// Number `index` of the van der Corput sequence in a base, 0..1.
float vanDerCorput(int index, int base) {
  float value = 0, place = 1;
  for (; index > 0; index /= base) value += float(index % base) * (place /= float(base));
  return value;
}

// Moves the picture so that pixel centres fall on the places of the pass.
Mat4 shifted(const Picture& picture) {
  Mat4 move(1);
  move[3] = Vec4(-2.0f * passShift(picture.pass) / Vec2(picture.width, picture.height), 0, 1);
  return move;
}

int supportedSamples(int wanted) {
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  return std::clamp(wanted, 1, std::max(1, int(most)));
}

}  // namespace

Vec2 passShift(int pass) {
  return pass == 0 ? Vec2(0) : Vec2(vanDerCorput(pass, 2) - 0.5f, vanDerCorput(pass, 3) - 0.5f);
}

SceneRenderer::SceneRenderer()
    : irradianceProgram_(Program::fromLibrary("mesh_irradiance.vert", "mesh_irradiance.frag")),
      texelIrradianceProgram_(
          Program::fromLibrary("mesh_irradiance.vert", "mesh_irradiance.frag", "#define TEXELS\n")),
      backgroundProgram_(Program::fromLibrary("fullscreen.vert", "background.frag")),
      toneProgram_(Program::fromLibrary("fullscreen.vert", "tone.frag")),
      meanProgram_(Program::fromLibrary("fullscreen.vert", "mean.frag")),
      meshArray_(VertexArray::create()),
      emptyArray_(VertexArray::create()) {
  for (Buffer* buffer : {&positions_, &normals_, &front_, &behind_, &objects_, &indices_, &materialBuffer_,
                         &radianceBuffer_, &backSamples_, &responses_, &circles_, &colours_, &texels_})
    *buffer = Buffer::create();
  radianceBuffer_.upload(std::span<const Rgb>(),
                         sizeof(Vec4));  // bound even where the shader does not read it
  noEnvironment_ = Texture::fromImage(Image(1, 1, 3), Wrap::RepeatX, false);  // black
  backgroundProgram_.set("environment", kEnvironmentUnit);
  toneProgram_.set("manySamples", kManySamplesUnit);
  toneProgram_.set("oneSample", kOneSampleUnit);
  toneProgram_.set("manyDepths", kManyDepthsUnit);
  toneProgram_.set("oneDepth", kOneDepthUnit);
  meanProgram_.set("sum", kOneSampleUnit);
  // The default number of bands; others are compiled when light in them is set.
  for (const Light light : {Light::Interpolated, Light::Fetched, Light::TexelRadiance, Light::Everywhere})
    radianceProgram(light, bands_);
  checkErrors("start of the GL renderer");
}

void SceneRenderer::setScene(const Scene& scene, std::span<const std::uint32_t> back) {
  uploadScene(scene, back, nullptr);
}

void SceneRenderer::setScene(const Scene& scene, const SampleSet& samples) {
  uploadScene(scene, samples.back, samples.texels.get());
}

void SceneRenderer::uploadScene(const Scene& scene, std::span<const std::uint32_t> back,
                                const TexelGrid* texels) {
  const TriMesh& mesh = scene.mesh;
  if (texels && texels->triangles.size() != mesh.triangleCount())
    throw ValueError("the texels are of another scene", "GL renderer", "bake the scene again");
  vertexCount_ = mesh.vertexCount();
  indexCount_ = int(3 * mesh.triangleCount());
  bounds_ = mesh.bounds();
  atTexels_ = texels != nullptr;
  const std::size_t fronts = texels ? texels->count : vertexCount_;
  sampleCount_ = fronts;
  back_.assign(fronts, kNone);
  twoSided_ = !back.empty();
  for (std::size_t s = 0; s < std::min(back.size(), fronts); ++s) {
    back_[s] = back[s];
    if (back[s] != kNone) sampleCount_ = std::max(sampleCount_, std::size_t(back[s]) + 1);
  }
  if (texels) uploadTexels(*texels);
  positions_.upload(std::span<const Vec3>(mesh.positions));
  normals_.upload(std::span<const Vec3>(mesh.normals));
  objects_.upload(std::span<const std::uint32_t>(scene.vertexObject));
  indices_.upload(std::span<const UVec3>(mesh.triangles));
  backSamples_.upload(std::span<const std::uint32_t>(back_));
  const std::vector<Rgb> black(vertexCount_, Rgb(0));
  front_.upload(std::span<const Rgb>(black));
  behind_.upload(std::span<const Rgb>(black));
  setIrradiance(std::vector<Rgb>(sampleCount_, Rgb(0)));
  setMaterials(scene.materials);

  meshArray_.floats(0, positions_, 3);
  meshArray_.floats(1, normals_, 3);
  meshArray_.floats(2, front_, 3);
  meshArray_.floats(3, behind_, 3);
  meshArray_.integers(4, objects_);
  meshArray_.indices(indices_);
  checkErrors("upload of the scene");
}

// As shaders/texels.glsl reads it.
void SceneRenderer::uploadTexels(const TexelGrid& grid) {
  constexpr std::size_t kWords = sizeof(TexelTriangle) / sizeof(std::uint32_t);
  std::vector<std::uint32_t> words(kWords * grid.triangles.size());
  std::memcpy(words.data(), grid.triangles.data(), words.size() * sizeof(std::uint32_t));
  texelStart_ = int(words.size());
  words.insert(words.end(), grid.texels.begin(), grid.texels.end());
  texels_.upload(std::span<const std::uint32_t>(words));
}

void SceneRenderer::setMaterials(std::span<const Material> materials) {
  materials_.assign(materials.begin(), materials.end());
  uploadResponses();
}

void SceneRenderer::setLight(const SurfaceLight& light) {
  switch (light.form) {
    case TransferForm::None: {
      ShRgb everywhere(light.bands);
      everywhere.c = light.radiance;
      return setLight(everywhere);
    }
    case TransferForm::Diffuse:
      return setIrradiance(light.irradiance);
    case TransferForm::Visibility:
    case TransferForm::Matrix:
      return setRadiance(light.bands, light.radiance, light.beyond);
  }
}

void SceneRenderer::setIrradiance(std::span<const Rgb> irradiance) {
  expectSamples(irradiance.size(), sampleCount_);
  uploadColours(irradiance);
  light_ = atTexels_ ? Light::TexelIrradiance : Light::Irradiance;
}

void SceneRenderer::setRadiance(int bands, std::span<const Rgb> coefficients, std::span<const Rgb> beyond) {
  expectSamples(coefficients.size(), sampleCount_ * std::size_t(shCount(bands)));
  if (!beyond.empty()) expectSamples(beyond.size(), sampleCount_);
  const bool interpolated = !twoSided_ && fitsBetweenStages(bands);
  useRadiance(atTexels_ ? Light::TexelRadiance : interpolated ? Light::Interpolated : Light::Fetched, bands);
  radianceBuffer_.upload(coefficients, sizeof(Vec4));
  uploadColours(beyond.empty() ? std::vector<Rgb>(sampleCount_, Rgb(0))
                               : std::vector<Rgb>(beyond.begin(), beyond.end()));
}

// One colour per sample: as they are for texels, else two per vertex, for its front and its back.
void SceneRenderer::uploadColours(std::span<const Rgb> perSample) {
  if (atTexels_) return colours_.upload(perSample);
  std::vector<Rgb> behind(vertexCount_, Rgb(0));
  for (std::size_t v = 0; v < vertexCount_; ++v)
    if (back_[v] != kNone) behind[v] = perSample[back_[v]];
  front_.upload(perSample.first(vertexCount_));
  behind_.upload(std::span<const Rgb>(behind));
}

void SceneRenderer::setLight(const ShRgb& light) {
  useRadiance(Light::Everywhere, light.bands);
  radianceProgram(light_, bands_).set("light", std::span<const Vec3>(light.c));
  if (!atTexels_) uploadColours(std::vector<Rgb>(sampleCount_, Rgb(0)));
}

void SceneRenderer::setEnvironment(const EnvironmentMap& map) {
  const bool latLong = map.report().mapping == EnvironmentMapping::LatLong;
  environment_ =
      Texture::fromImage(latLong ? map.pixels() : toLatLong(map, kLatLongWidth, kLatLongWidth / 2).pixels(),
                         Wrap::RepeatX, false);
  checkErrors("upload of the environment");
}

void SceneRenderer::useRadiance(Light light, int bands) {
  if (bands < 1 || bands > kMaxBands)
    throw ValueError(std::to_string(bands) + " bands", "GL renderer",
                     "use 1 to " + std::to_string(kMaxBands) + " bands");
  radianceProgram(light, bands);
  light_ = light;
  if (bands == bands_) return;
  bands_ = bands;
  uploadResponses();
}

Program& SceneRenderer::radianceProgram(Light light, int bands) {
  Program& program = radiancePrograms_[{light, bands}];
  if (program) return program;
  std::string prelude = shGlsl(bands) + "#define RESPONSE_ROWS " + std::to_string(kResponseRows) + "\n";
  if (light == Light::Interpolated) prelude += "#define INTERPOLATED\n";
  if (light == Light::Everywhere) prelude += "#define EVERYWHERE\n";
  if (light == Light::TexelRadiance) prelude += "#define TEXELS\n";
  program = Program::fromLibrary("mesh_radiance.vert", "mesh_radiance.frag", prelude);
  return program;
}

// Materials, and for the glossy ones a table of responses each; equal exponents share one.
void SceneRenderer::uploadResponses() {
  std::vector<GpuMaterial> packed;
  std::vector<float> exponents;
  std::vector<std::uint32_t> tables;
  for (const Material& m : materials_) {
    int table = -1;
    if (m.glossy()) {
      table = int(std::find(exponents.begin(), exponents.end(), m.exponent) - exponents.begin());
      if (table == int(exponents.size())) {
        exponents.push_back(m.exponent);
        const GlossyResponse response(m.exponent, bands_);
        lobes_.assign(response.lobes().begin(), response.lobes().end());
        appendResponse(response, tables);
      }
    }
    packed.push_back({Vec4(m.albedo, m.twoSided ? 1 : 0), Vec4(m.specular, float(table))});
  }
  if (tables.empty()) tables.push_back(0);  // a buffer without contents cannot be bound
  materialBuffer_.upload(std::span<const GpuMaterial>(packed));
  responses_.upload(std::span<const std::uint32_t>(tables));
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
  if (indexCount_ > 0) drawMesh(picture);
  const bool any = environment_ || !picture.circles.empty() || picture.constant != Rgb(0);
  if (picture.background == Background::Environment && any) drawBackground(picture);
}

Program& SceneRenderer::meshProgram() {
  if (light_ == Light::Irradiance) return irradianceProgram_;
  if (light_ == Light::TexelIrradiance) return texelIrradianceProgram_;
  return radianceProgram(light_, bands_);
}

void SceneRenderer::drawMesh(const Picture& picture) {
  const Vec2 depth = depthRange(picture.camera, bounds_);
  const float aspect = float(picture.width) / float(picture.height);
  Program& program = meshProgram();
  program.set("worldToClip",
              shifted(picture) * picture.camera.projection(aspect, depth.x, depth.y) * picture.camera.view());
  materialBuffer_.bindStorage(kMaterialBinding);
  if (light_ != Light::Irradiance) {
    indices_.bindStorage(kCornerBinding);
    positions_.bindStorage(kPositionBinding);
    backSamples_.bindStorage(kBehindBinding);
  }
  if (light_ == Light::TexelIrradiance || light_ == Light::TexelRadiance) {
    program.set("texelStart", texelStart_);
    colours_.bindStorage(kColourBinding);
    texels_.bindStorage(kTexelBinding);
  }
  if (light_ != Light::Irradiance && light_ != Light::TexelIrradiance) {
    const Camera& camera = picture.camera;
    program.set("viewer", camera.orthographic ? Vec4(camera.axes().normal, 0) : Vec4(camera.eye, 1));
    if (!lobes_.empty()) program.set("lobes", std::span<const Vec2>(lobes_));
    radianceBuffer_.bindStorage(kRadianceBinding);
    responses_.bindStorage(kResponseBinding);
  }
  program.use();
  glBindVertexArray(meshArray_.id());
  glDrawElements(GL_TRIANGLES, indexCount_, GL_UNSIGNED_INT, nullptr);
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
