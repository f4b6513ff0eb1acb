#pragma once
// Draws a mesh by precomputed transfer with OpenGL 4.5: materials met by the light at the mesh's samples.
// The CPU's twin is shade/render.h. Every function needs the context that was current when it was made.

#include "libprt/basis/sh.h"
#include "libprt/gl/objects.h"
#include "libprt/gl/program.h"
#include "libprt/gl/surface_view.h"
#include "libprt/shade/surface_light.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace prt::gl {

class MeshPass {
 public:
  /// Compiles its shaders. Throws ResourceError when the driver refuses.
  MeshPass();

  /// The geometry and its materials, without light. `back` as SampleSet::back; `texels` where light is known
  /// at texels, null where at vertices. Throws ValueError when they are of another scene.
  void setScene(const Scene& scene, std::span<const std::uint32_t> back, const TexelGrid* texels);
  /// [objects].
  void setMaterials(std::span<const Material> materials);
  /// [objects]: radiance that reflecting sides send of their own; empty: none. Until the next scene.
  void setEmission(std::span<const Rgb> emission);

  // The light; the last one given counts. See SceneRenderer.
  void setLight(const SurfaceLight& light);
  void setIrradiance(std::span<const Rgb> irradiance);
  void setRadiance(int bands, std::span<const Rgb> coefficients, std::span<const Rgb> beyond = {});
  void setLight(const ShRgb& light);

  bool empty() const { return indexCount_ == 0; }
  const Box3& bounds() const { return bounds_; }
  void draw(const SurfaceView& view);

 private:
  enum class Light { Irradiance, TexelIrradiance, Interpolated, Fetched, TexelRadiance, Everywhere };

  void uploadTexels(const TexelGrid& grid);
  void uploadColours(std::span<const Rgb> perSample);
  void uploadResponses();
  void useRadiance(Light light, int bands);
  Program& radianceProgram(Light light, int bands);
  Program& program();

  Program irradianceProgram_, texelIrradianceProgram_;
  std::map<std::pair<Light, int>, Program> radiancePrograms_;  // made for a number of bands
  VertexArray meshArray_;
  Buffer positions_, normals_, front_, behind_, objects_, indices_;
  Buffer materialBuffer_, radianceBuffer_, backSamples_, responses_, colours_, texels_;
  std::vector<Material> materials_;
  std::vector<Rgb> emission_;
  std::vector<std::uint32_t> back_;
  std::vector<Vec2> lobes_;  // of the responses, see GlossyResponse
  Light light_ = Light::Irradiance;
  int bands_ = 5;  // of the radiance and the responses
  bool twoSided_ = false;
  bool atTexels_ = false;  // where light is known
  int texelStart_ = 0;     // of the rectangles in texels_
  int indexCount_ = 0;
  std::size_t vertexCount_ = 0, sampleCount_ = 0;
  Box3 bounds_;
};

}  // namespace prt::gl
