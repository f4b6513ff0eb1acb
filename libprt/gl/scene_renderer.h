#pragma once
// Draws a relit scene with OpenGL 4.5: what the studio's viewport shows and `prt relight --backend gl`
// writes. The CPU renderer in shade/ makes the same picture; the tests compare the two.
// Every function needs the context that was current when the renderer was made.

#include "libprt/core/image.h"
#include "libprt/gl/objects.h"
#include "libprt/gl/program.h"
#include "libprt/shade/camera.h"
#include "libprt/transport/scene.h"

#include <span>

namespace prt::gl {

enum class Background {
  Black,       ///< nothing: black, alpha 0
  Environment  ///< the environment map, alpha 1
};

/// What one picture is of. The light comes with setIrradiance().
struct Picture {
  Camera camera;
  int width = 0;
  int height = 0;
  int samples = 4;  ///< per pixel; what the driver cannot do is lowered
  Background background = Background::Environment;
  float environmentRotation = 0;  ///< radians, counter-clockwise seen from +Y
  float exposure = 0;             ///< stops
};

class SceneRenderer {
 public:
  /// Compiles every shader. Throws ResourceError when the driver refuses.
  SceneRenderer();

  /// The geometry and its materials. Forgets the light.
  void setScene(const Scene& scene);
  /// Materials alone, [objects]: takes effect in the next picture.
  void setMaterials(std::span<const Material> materials);
  /// Irradiance per vertex, [V]: every surface is drawn as albedo/pi * irradiance.
  void setIrradiance(std::span<const Rgb> irradiance);
  /// The lat-long map behind the model, radiance as it lights (top row +Y, centre column -Z).
  void setEnvironment(const Image& latLong);

  /// Draws into `framebuffer` (0 = the window), tone-mapped, over its whole width x height.
  void draw(const Picture& picture, unsigned framebuffer);
  /// Linear radiance: float RGBA, alpha = coverage, rows from the top.
  Image render(const Picture& picture);
  /// As draw(), read back: values 0..1 on the screen's curve.
  Image renderToned(const Picture& picture);

 private:
  void drawRadiance(const Picture& picture, PixelFormat format, int samples);
  void drawMesh(const Picture& picture);
  void drawBackground(const Picture& picture);

  Program meshProgram_, backgroundProgram_, toneProgram_;
  VertexArray meshArray_, emptyArray_;
  Buffer positions_, normals_, irradiance_, objects_, indices_, materials_;
  Texture environment_;
  Framebuffer radiance_;
  PixelFormat radianceFormat_ = PixelFormat::Rgba16f;
  int indexCount_ = 0;
  int vertexCount_ = 0;
  Box3 bounds_;
};

}  // namespace prt::gl
