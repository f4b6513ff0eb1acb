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
#include <vector>

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
  /// Colours of triangles, in place of the values, and lines. Throws ValueError on another number of
  /// triangles.
  void setPaint(const SurfacePaint& paint);
  /// Layers of marks, the lowest first.
  void setMarks(std::span<const SurfaceMarks> marks);
  void setMarks(const SurfaceMarks& marks) { setMarks(std::span(&marks, 1)); }
  /// Whether draw() would change anything.
  bool empty() const { return !hasValues_ && !hasPaint_ && !marked_ && seams_.empty(); }

  /// Over the colours of `framebuffer` (0 = the window), which are display-encoded. grid * grid samples per
  /// pixel.
  void draw(const OverlayPicture& picture, unsigned framebuffer);
  /// What draw() lays over: float RGBA, premultiplied, rows from the top.
  Image render(const OverlayPicture& picture);

 private:
  /// Marks as they were uploaded.
  struct Uploaded {
    Buffer points, edges, triangles;
    int pointCount = 0, edgeCount = 0, triangleCount = 0;
    Rgb color{1};
    float hidden = 0, size = 1, fill = 0;

    Uploaded();
    bool empty() const { return pointCount + edgeCount + triangleCount == 0; }
    void upload(const SurfaceMarks& marks);
  };
  void drawSurface(const OverlayPicture& picture, int samples);
  void setView(Program& program, const OverlayPicture& picture) const;
  void drawMarks(const OverlayPicture& picture, const Uploaded& marks);
  void drawMarks(float pixelScale, const Buffer& places, int corners, int count);
  void compose(int samples, bool showSurface, const Rgb& markColor);

  Program surfaceProgram_, paintProgram_, marksProgram_, composeProgram_;
  VertexArray meshArray_, emptyArray_;
  Buffer positions_, normals_, values_, indices_, paintColors_, paintUv_;
  Texture scale_, picture_;
  Framebuffer surface_, cover_;
  Uploaded seams_;
  std::vector<Uploaded> marks_;
  Box3 bounds_;
  std::size_t vertexCount_ = 0;
  int indexCount_ = 0;
  float squares_ = 0;  // of the paint; 0: none
  bool hasValues_ = false, hasPaint_ = false, pictured_ = false, marked_ = false;
};

}  // namespace prt::gl
