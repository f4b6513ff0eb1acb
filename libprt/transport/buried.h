#pragma once
// Samples that lie inside of something, or in a gap under something that is narrower than their mesh: a
// vertex of one object inside another, of a body that cuts itself, of the ground below a vase's foot. What
// they see is of no use, and would bleed into the visible part of their triangles, so they take the values
// of their neighbours on the mesh.

#include "libprt/core/job.h"
#include "libprt/transport/ray_scene.h"
#include "libprt/transport/sample_set.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Marks (1) the samples for which more than a quarter of the rays over the hemisphere of the geometric
/// normal meet the back of a surface that has an inside; looks only at those with candidates[s] != 0.
/// A connected piece of surface has an inside when it is closed or nearly so (its area vectors add up to
/// less than a tenth of its area) and is not two-sided: under an open sheet nothing is buried.
/// Marks also vertices and texels that another object covers: at most an eighth is open, and more than half
/// of the rays meet that object within the mean length of the vertex's edges, or of a texel's side.
std::vector<std::uint8_t> findBuried(const Scene& scene, const RayScene& rays, const SampleSet& samples,
                                     std::span<const std::uint8_t> candidates, std::uint64_t seed, Job& job);

/// Takes the values of buried vertices from the mean of their neighbours along the mesh's edges, those of
/// buried texels from their neighbours in the chart, layer by layer from the outside in. What is buried as a
/// whole keeps its own values, and so do samples that are neither vertices nor texels.
class BuriedFill {
 public:
  BuriedFill() = default;
  BuriedFill(const Scene& scene, const SampleSet& samples, std::span<const std::uint8_t> buried);

  bool empty() const { return target_.empty(); }
  /// Samples to fill, in the order in which they must be filled, and what each is the mean of.
  std::size_t size() const { return target_.size(); }
  std::uint32_t target(std::size_t i) const { return target_[i]; }
  std::span<const std::uint32_t> sources(std::size_t i) const {
    return std::span(source_).subspan(first_[i], first_[i + 1] - first_[i]);
  }
  /// `values` holds `stride` numbers per sample.
  void apply(std::span<float> values, std::size_t stride) const;

 private:
  std::vector<std::uint32_t> target_;  // samples to fill, in order
  std::vector<std::uint32_t> first_;   // [targets + 1] where their sources begin
  std::vector<std::uint32_t> source_;
};

}  // namespace prt
