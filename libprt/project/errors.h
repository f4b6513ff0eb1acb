#pragma once
// Where a baked project is wrong: transport/error_map.h for the parts of a recipe.

#include "libprt/light/light_rig.h"
#include "libprt/project/recipe.h"
#include "libprt/transport/error_map.h"

namespace prt {

/// The settings of the transfer stages, `auto` decided.
TransferSettings transferSettings(const Recipe& recipe);

/// Traces what an error map needs; as ErrorProbe::measure(). `geometry` and `samples` are the products of
/// their stages, `transfer` a product of the recipe; materials are the recipe's.
ErrorProbe probeErrors(const Scene& geometry, const SampleSet& samples,
                       std::shared_ptr<const Transfer> transfer, const Recipe& recipe, Job& job,
                       const std::function<void(ErrorProbe)>& preview = {});

/// The lights of a project as errors are judged under them: as they are, and as pictures show them.
JudgedLight judgedLight(const LightRig& lights, int bands, const MethodRecipe& method);
/// The same with the coefficients of all lights at hand, in kErrorBands bands.
JudgedLight judgedLight(const ShRgb& whole, int bands, const MethodRecipe& method);

}  // namespace prt
