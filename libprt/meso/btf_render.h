#pragma once
// Equation (5) taken literally (Bi-Scale Radiance Transfer, section 4.2): the patch is rendered under single
// directional lights, a picture for each light and view, and the pictures are weighed into the basis. 8 x 16
// lights times 8 x 8 views are 8192 pictures. It exists to check the fast bake (rtt_bake.h) and to make BTFs.
//
// Direct light is traced per picture sample, so shadows are sharp; light inside the patch bounces between the
// surface's points as in the fast bake, for all lights at once.

#include "libprt/meso/light_projection.h"
#include "libprt/meso/rtt_bake.h"

#include <filesystem>
#include <functional>

namespace prt {

/// The pictures of one view: radiance under each light of irradiance 1 across its beam.
struct BtfView {
  int index = 0;  ///< on the square of views
  Vec3 direction{0, 0, 1};
  int texels = 0, channels = 1;
  Rgb colour{1};  ///< factor on all of it
  std::size_t lights = 0;
  std::vector<float> values;  ///< [v, u, light, channel], v up

  /// The picture of one light, v = 1 at the top, three channels.
  Image picture(std::size_t light) const;
};

/// Gets the views one after the other, in the order of their indices; on the caller's thread.
using BtfSink = std::function<void(const BtfView&)>;

/// Renders all views of `settings` under `lights`. The job counts pictures. Throws as bakeRtt does.
void renderBtf(const PatchScene& patch, const RttSettings& settings, const LightSet& lights, Job& job,
               const BtfSink& sink);

/// The views of arbitrary directions (unit, z > 0) instead of those of the square; index = place in the list.
void renderBtf(const PatchScene& patch, const RttSettings& settings, const LightSet& lights,
               std::span<const Vec3> views, Job& job, const BtfSink& sink);

/// Equation (5): renders and projects; pictures go to `keep` too, when given.
Rtt bakeRttByImages(const PatchScene& patch, const RttSettings& settings, const LightSet& lights,
                    LightFit fit, Job& job, const BtfSink& keep = {});

/// Puts one view's pictures into a table through projectionMatrix().
void projectView(const BtfView& view, std::span<const double> matrix, Rtt& rtt, Job& job);

/// Writes pictures as EXR files, view_VVV_light_LLL.exr, and at the end manifest.json, from which importBtf()
/// reads them again. Throws FileError when it cannot write.
class BtfWriter {
 public:
  /// Makes the folder where it is not there.
  explicit BtfWriter(std::filesystem::path folder, const LightSet& lights);
  void add(const BtfView& view, Job& job);
  /// Returns how many pictures there are.
  std::size_t finish();

 private:
  std::filesystem::path folder_;
  LightSet lights_;
  std::vector<std::pair<Vec3, int>> views_;  // direction, index
};

}  // namespace prt
