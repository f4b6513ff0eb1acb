#include "libprt/gl/mesh_pass.h"

#include "libprt/core/error.h"
#include "libprt/gl/sh_glsl.h"
#include "libprt/material/glossy_response.h"

#include <epoxy/gl.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace prt::gl {

namespace {

constexpr unsigned kMaterialBinding = 0, kCornerBinding = 1, kPositionBinding = 2, kRadianceBinding = 3,
                   kBehindBinding = 4, kResponseBinding = 5, kColourBinding = 7, kTexelBinding = 8;
constexpr int kResponseRows = 512;  // view angles in a table of responses
constexpr int kMaxBands = 10;

// As shaders/material.glsl has it.
struct GpuMaterial {
  Vec4 albedo;
  Vec4 specular;
  Vec4 emission;
};

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

}  // namespace

MeshPass::MeshPass()
    : irradianceProgram_(Program::fromLibrary("mesh_irradiance.vert", "mesh_irradiance.frag")),
      texelIrradianceProgram_(
          Program::fromLibrary("mesh_irradiance.vert", "mesh_irradiance.frag", "#define TEXELS\n")),
      meshArray_(VertexArray::create()) {
  for (Buffer* buffer : {&positions_, &normals_, &front_, &behind_, &objects_, &indices_, &materialBuffer_,
                         &radianceBuffer_, &backSamples_, &responses_, &colours_, &texels_})
    *buffer = Buffer::create();
  radianceBuffer_.upload(std::span<const Rgb>(),
                         sizeof(Vec4));  // bound even where the shader does not read it
  // The default number of bands; others are compiled when light in them is set.
  for (const Light light : {Light::Interpolated, Light::Fetched, Light::TexelRadiance, Light::Everywhere})
    radianceProgram(light, bands_);
}

void MeshPass::setScene(const Scene& scene, std::span<const std::uint32_t> back, const TexelGrid* texels) {
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
  emission_.clear();
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
void MeshPass::uploadTexels(const TexelGrid& grid) {
  constexpr std::size_t kWords = sizeof(TexelTriangle) / sizeof(std::uint32_t);
  std::vector<std::uint32_t> words(kWords * grid.triangles.size());
  std::memcpy(words.data(), grid.triangles.data(), words.size() * sizeof(std::uint32_t));
  texelStart_ = int(words.size());
  words.insert(words.end(), grid.texels.begin(), grid.texels.end());
  texels_.upload(std::span<const std::uint32_t>(words));
}

void MeshPass::setMaterials(std::span<const Material> materials) {
  materials_.assign(materials.begin(), materials.end());
  uploadResponses();
}

void MeshPass::setEmission(std::span<const Rgb> emission) {
  emission_.assign(emission.begin(), emission.end());
  uploadResponses();
}

void MeshPass::setLight(const SurfaceLight& light) {
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

void MeshPass::setIrradiance(std::span<const Rgb> irradiance) {
  expectSamples(irradiance.size(), sampleCount_);
  uploadColours(irradiance);
  light_ = atTexels_ ? Light::TexelIrradiance : Light::Irradiance;
}

void MeshPass::setRadiance(int bands, std::span<const Rgb> coefficients, std::span<const Rgb> beyond) {
  expectSamples(coefficients.size(), sampleCount_ * std::size_t(shCount(bands)));
  if (!beyond.empty()) expectSamples(beyond.size(), sampleCount_);
  const bool interpolated = !twoSided_ && fitsBetweenStages(bands);
  useRadiance(atTexels_ ? Light::TexelRadiance : interpolated ? Light::Interpolated : Light::Fetched, bands);
  radianceBuffer_.upload(coefficients, sizeof(Vec4));
  uploadColours(beyond.empty() ? std::vector<Rgb>(sampleCount_, Rgb(0))
                               : std::vector<Rgb>(beyond.begin(), beyond.end()));
}

// One colour per sample: as they are for texels, else two per vertex, for its front and its back.
void MeshPass::uploadColours(std::span<const Rgb> perSample) {
  if (atTexels_) return colours_.upload(perSample);
  std::vector<Rgb> behind(vertexCount_, Rgb(0));
  for (std::size_t v = 0; v < vertexCount_; ++v)
    if (back_[v] != kNone) behind[v] = perSample[back_[v]];
  front_.upload(perSample.first(vertexCount_));
  behind_.upload(std::span<const Rgb>(behind));
}

void MeshPass::setLight(const ShRgb& light) {
  useRadiance(Light::Everywhere, light.bands);
  radianceProgram(light_, bands_).set("light", std::span<const Vec3>(light.c));
  if (!atTexels_) uploadColours(std::vector<Rgb>(sampleCount_, Rgb(0)));
}

void MeshPass::useRadiance(Light light, int bands) {
  if (bands < 1 || bands > kMaxBands)
    throw ValueError(std::to_string(bands) + " bands", "GL renderer",
                     "use 1 to " + std::to_string(kMaxBands) + " bands");
  radianceProgram(light, bands);
  light_ = light;
  if (bands == bands_) return;
  bands_ = bands;
  uploadResponses();
}

Program& MeshPass::radianceProgram(Light light, int bands) {
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
void MeshPass::uploadResponses() {
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
    const std::size_t object = packed.size();
    packed.push_back({Vec4(m.albedo, m.twoSided ? 1 : 0), Vec4(m.specular, float(table)),
                      Vec4(object < emission_.size() ? emission_[object] : Rgb(0), 0)});
  }
  if (tables.empty()) tables.push_back(0);  // a buffer without contents cannot be bound
  materialBuffer_.upload(std::span<const GpuMaterial>(packed));
  responses_.upload(std::span<const std::uint32_t>(tables));
}

Program& MeshPass::program() {
  if (light_ == Light::Irradiance) return irradianceProgram_;
  if (light_ == Light::TexelIrradiance) return texelIrradianceProgram_;
  return radianceProgram(light_, bands_);
}

void MeshPass::draw(const SurfaceView& view) {
  Program& program = this->program();
  program.set("worldToClip", view.worldToClip);
  materialBuffer_.bindStorage(kMaterialBinding);
  indices_.bindStorage(kCornerBinding);
  positions_.bindStorage(kPositionBinding);
  if (light_ != Light::Irradiance) backSamples_.bindStorage(kBehindBinding);
  if (light_ == Light::TexelIrradiance || light_ == Light::TexelRadiance) {
    program.set("texelStart", texelStart_);
    colours_.bindStorage(kColourBinding);
    texels_.bindStorage(kTexelBinding);
  }
  if (light_ != Light::Irradiance && light_ != Light::TexelIrradiance) {
    program.set("viewer", view.steps.viewer);
    if (!lobes_.empty()) program.set("lobes", std::span<const Vec2>(lobes_));
    radianceBuffer_.bindStorage(kRadianceBinding);
    responses_.bindStorage(kResponseBinding);
  }
  program.use();
  glBindVertexArray(meshArray_.id());
  glDrawElements(GL_TRIANGLES, indexCount_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace prt::gl
