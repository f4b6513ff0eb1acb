#pragma once
// Draws a surface that carries a patch with OpenGL 4.5: equation (4) of Bi-Scale Radiance Transfer, as
// shade/biscale.h has it. Light is transferred to the vertices by the CPU renderer's own code; the fragment
// shader interpolates it over the triangle and meets it with the radiance transfer texture at the texel that
// the id map names, between the four views around the viewer's direction. The views of a texel lie together
// in one buffer and are weighed by the shader, so nothing bleeds from one texel's views into another's.
// A surface with a filter is filtered as there, by the same formulas (shade/patch_filter.h). Objects without
// a patch take the texel of their material (shade/plain_objects.h).
// Every function needs the context that was current when it was made.

#include "libprt/basis/sh.h"
#include "libprt/core/job.h"
#include "libprt/gl/objects.h"
#include "libprt/gl/program.h"
#include "libprt/gl/surface_view.h"
#include "libprt/gl/transfer_pass.h"
#include "libprt/shade/biscale_view.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/transfer.h"

#include <array>
#include <memory>
#include <optional>

namespace prt::gl {

class BiscalePass {
 public:
  /// Compiles its shaders. Throws ResourceError when the driver refuses.
  BiscalePass();

  /// Null: nothing is drawn. Light is forgotten; parts that the last surface had too are not sent again.
  /// Throws ResourceError when the patch is larger than the driver takes.
  void setSurface(std::shared_ptr<const BiscaleSurface> surface);
  /// Light at all frames of the surface, as BiscaleLight has it: ValueError for the form Diffuse and for
  /// other scenes' samples.
  void setLight(const SampleSet& samples, const Transfer& transfer, const ShRgb& light, Job& job);

  /// Keeps transfer of the surface on the graphics card, so that light costs it one product per frame, as
  /// long as the surface's frames stay. False, and nothing is kept, where it is empty or not of as many
  /// frames.
  bool keepTransfer(const TurnedTransfer& turned);
  bool keepsTransfer() const { return transfer_ && !transfer_->empty(); }
  /// Light by the transfer that was kept.
  void setLight(const ShRgb& light);

  bool empty() const { return !surface_; }
  const Box3& bounds() const { return bounds_; }
  /// `viewDependent` false: the patch, not the rest, looks from everywhere as it does from above.
  void draw(const SurfaceView& view, bool viewDependent);

 private:
  void uploadGeometry(const BiscaleSurface& surface);
  void uploadCover(const PatchCover& cover);
  void uploadFilter(const PatchFilter& filter);
  void uploadPlain(const BiscaleSurface& surface);
  Program& program();

  std::shared_ptr<const BiscaleSurface> surface_;
  std::array<Program, 4> programs_;  // filter + 2 * layers; each made when it is wanted first
  VertexArray array_;
  Buffer positions_, normals_, tangents_, corners_, coordinates_;
  std::optional<TransferPass> transfer_;  // made for the first transfer that is kept
  BufferTexture light_, responses_, plainResponses_;
  Buffer plainTexels_;
  Texture ids_, layerWeights_;
  Buffer rectangles_, charts_;  // of the filter, like those that follow
  BufferTexture coefficients_, terms_;
  Texture owners_;
  Box3 bounds_;
  int indexCount_ = 0;
};

}  // namespace prt::gl
