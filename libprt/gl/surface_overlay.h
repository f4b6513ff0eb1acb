#pragma once
// Lays false colour and marks over a picture of the surface, in OpenGL 4.5. It has a depth pass of its own
// and touches nothing but the target's colours, so it goes over any picture taken with the same camera. Its
// CPU twin is shade/surface_overlay.h, where the meaning of values and marks is told; the tests compare the
// two. Every function needs the context that was current when the overlay was made.

#include "libprt/core/image.h"
#include "libprt/gl/objects.h"
#include "libprt/gl/program.h"
#include "libprt/mesh/mesh.h"
#include "libprt/shade/surface_overlay.h"

#include <span>

namespace prt::gl {

class SurfaceOverlay {
 public:
  /// Compiles its shaders. Throws ResourceError when the driver refuses.
  SurfaceOverlay();

  /// The surface that is drawn over; forgets values.
  void setMesh(const TriMesh& mesh);
  /// One value per vertex on the magnitude scale, or none: the surface keeps its look. Throws ValueError on
  /// another number of values.
  void setValues(std::span<const float> values);
  void setMarks(const SurfaceMarks& marks);
  /// Whether draw() would change anything.
  bool empty() const { return !hasValues_ && pointCount_ + edgeCount_ + triangleCount_ == 0; }

  /// Over the colours of `framebuffer` (0 = the window), which are display-encoded. grid * grid samples per
  /// pixel.
  void draw(const OverlayPicture& picture, unsigned framebuffer);
  /// What draw() lays over: float RGBA, premultiplied, rows from the top.
  Image render(const OverlayPicture& picture);

 private:
  void drawSurface(const OverlayPicture& picture, int samples);
  void drawMarks(const OverlayPicture& picture);
  void drawMarks(const OverlayPicture& picture, const Buffer& places, int corners, int count);
  void compose(int samples);

  Program surfaceProgram_, marksProgram_, composeProgram_;
  VertexArray meshArray_, emptyArray_;
  Buffer positions_, normals_, values_, indices_, points_, edges_, triangles_;
  Texture scale_;
  Framebuffer surface_, marks_;
  Rgb markColor_{1};
  Box3 bounds_;
  std::size_t vertexCount_ = 0;
  int indexCount_ = 0, pointCount_ = 0, edgeCount_ = 0, triangleCount_ = 0;
  bool hasValues_ = false;
};

}  // namespace prt::gl
