#pragma once
// Objects of a scene that carry no patch where others do. To the bi-scale renderer each is a flat patch of
// one texel: B(view) of its material in its local frame (material/glossy_response.h), in a table of their
// own, so that its light and its shading are the patch's. What is between such an object and the same
// object in render.h: 16-bit floats, interpolation between the 32 x 32 views of a glossy material, light
// interpolated in the frames of the triangle's corners, and bands that the patch's texture does not have.

#include "libprt/shade/response_table.h"
#include "libprt/transport/scene.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

class PlainObjects {
 public:
  /// "Carries the patch", in place of a texel.
  static constexpr std::uint32_t kPatched = 0xffffffffu;
  static constexpr int kViews = 32;  ///< a side; 1 when no material is glossy

  /// `carries` and `materials`: of each object; the scene's own materials have no part. `bands` of the
  /// patch's texture. Throws ValueError when there are not as many of them as objects.
  PlainObjects(const Scene& scene, const std::vector<bool>& carries, std::span<const Material> materials,
               int bands);

  /// The texel of responses() that a triangle shows, or kPatched.
  std::uint32_t texelOf(std::uint32_t triangle) const { return texels_[triangle]; }
  std::span<const std::uint32_t> texels() const { return texels_; }  ///< [F]
  /// Three channels, whatever the patch's texture has; colour 1.
  const ResponseTable& responses() const { return responses_; }

 private:
  std::vector<std::uint32_t> texels_;
  ResponseTable responses_;
};

}  // namespace prt
