#pragma once
// Draws a relit scene with OpenGL 4.5: what the studio's viewport shows and `prt relight --backend gl`
// writes. The CPU renderer in shade/ makes the same picture; the tests compare the two.
// Every function needs the context that was current when the renderer was made.

#include "libprt/basis/sh.h"
#include "libprt/core/image.h"
#include "libprt/gl/biscale_pass.h"
#include "libprt/gl/mesh_pass.h"
#include "libprt/gl/objects.h"
#include "libprt/gl/program.h"
#include "libprt/light/environment.h"
#include "libprt/light/light_rig.h"
#include "libprt/shade/camera.h"
#include "libprt/shade/surface_light.h"
#include "libprt/shade/surroundings.h"
#include "libprt/shade/tonemap.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace prt::gl {

enum class Background {
  Black,       ///< nothing: black, alpha 0
  Environment  ///< all light that has a size: environment map, circles, constant; alpha 1. None: as Black
};

/// What one picture is of.
struct Picture {
  Camera camera;
  int width = 0;
  int height = 0;
  int samples = 4;  ///< per pixel; what the driver cannot do is lowered
  /// The number of this picture in a series of the same view, for draw(): each is taken at other places in
  /// the pixels and the mean of all so far is shown. Smooth edges where many samples at once are slow.
  int pass = 0;
  Background background = Background::Environment;
  Rgb behind{0};                   ///< of draw(): what is seen where alpha is 0, as the screen shows it
  float environmentRotation = 0;   ///< radians, counter-clockwise seen from +Y
  float environmentIntensity = 1;  ///< 0: no map is seen
  std::vector<CircleLight> circles = {};
  Rgb constant{0};
  /// Between texels, and edges of circles a pixel wide; otherwise piecewise constant, as the map lights.
  bool smoothEnvironment = false;
  bool viewDependent = true;  ///< false: a patch looks from everywhere as it does from above
  ToneSettings tone = {};     ///< of draw() and renderToned()
  float gridSpacing =
      0;  ///< of draw() and renderToned(): lines of the ground grid, see shade/ground_grid.h; 0: none
};

/// Where in its pixels a pass is taken: from the centre, in pixels right and up; pass 0 at the centre.
Vec2 passShift(int pass);

class SceneRenderer {
 public:
  /// Compiles every shader. Throws ResourceError when the driver refuses.
  SceneRenderer();

  /// The geometry and its materials, without light. `back` as SampleSet::back: the samples of two-sided
  /// vertices' other sides; empty when there are none.
  void setScene(const Scene& scene, std::span<const std::uint32_t> back = {});
  /// The same for light at `samples`, which cover the surface: vertices, or texels of an atlas, between which
  /// light is interpolated at every pixel.
  void setScene(const Scene& scene, const SampleSet& samples);
  /// Materials alone, [objects]: takes effect in the next picture.
  void setMaterials(std::span<const Material> materials);

  // The light; the last one given counts.

  /// What arrives at the samples of the scene, in any form.
  void setLight(const SurfaceLight& light);
  /// Irradiance per sample, [S]: every surface is drawn as albedo/pi * irradiance.
  void setIrradiance(std::span<const Rgb> irradiance);
  /// Transferred radiance per sample, [S * bands^2], object frame: diffuse with the pixel's normal, and
  /// glossy materials. `beyond` as SurfaceLight::beyond, [S] or empty. 1 to 10 bands.
  void setRadiance(int bands, std::span<const Rgb> coefficients, std::span<const Rgb> beyond = {});
  /// The same light everywhere: no shadows. 1 to 10 bands.
  void setLight(const ShRgb& light);

  /// The patch that the scene carries: it is drawn in place of the mesh and its materials. Null: none.
  void setPatch(std::shared_ptr<const BiscaleSurface> patch);
  /// The light on it, see BiscalePass::setLight(); black until there is one.
  void setPatchLight(const SampleSet& samples, const Transfer& transfer, const ShRgb& light, Job& job);

  /// See BiscalePass::keepTransfer(): afterwards light alone is enough, until there is another patch.
  bool keepPatchTransfer(const TurnedTransfer& turned);
  void setPatchLight(const ShRgb& light);

  /// Objects that are seen with the scene, as they are lit. Their geometry is sent again only when it is
  /// another one.
  void setSurroundings(const Surroundings& surroundings);

  /// The map behind the model: lat-long as it is, other mappings resampled to one.
  void setEnvironment(const EnvironmentMap& map);

  /// Draws into `framebuffer` (0 = the window), tone-mapped, over its whole width x height.
  void draw(const Picture& picture, unsigned framebuffer);
  /// What draw() showed last, without drawing anything: a series of passes does not go on.
  void showAgain(unsigned framebuffer);
  /// Linear radiance: float RGBA, alpha = coverage, rows from the top.
  Image render(const Picture& picture);
  /// As draw(), read back: values 0..1 on the screen's curve.
  Image renderToned(const Picture& picture);

 private:
  void drawRadiance(const Picture& picture, PixelFormat format, int samples);
  void drawSurface(const Picture& picture);
  void drawBackground(const Picture& picture);
  void drawToned(const Picture& picture, int samples);

  MeshPass mesh_;
  std::optional<BiscalePass> patch_;  // made for the first one
  std::optional<MeshPass> around_;    // the same
  std::shared_ptr<const Scene> aroundScene_;
  Program backgroundProgram_, toneProgram_, meanProgram_;
  VertexArray emptyArray_;
  Buffer circles_;
  Texture environment_, noEnvironment_;
  Framebuffer radiance_, passes_;
  int passCount_ = 0;  // summed in passes_
  PixelFormat radianceFormat_ = PixelFormat::Rgba16f;
};

}  // namespace prt::gl
