#pragma once
// A whole bake, as the command line and the studio run it: recipe in, saved project out.

#include "libprt/meso/view_error.h"
#include "libprt/project/pipeline.h"
#include "libprt/project/scenes.h"
#include "libprt/transport/interpolation_floor.h"
#include "libprt/transport/transfer.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace prt {

struct BakeOptions {
  std::filesystem::path output;     ///< the project; made, or gone on with
  std::vector<std::string> stages;  ///< what to make; empty = everything
  double checkpointSeconds = 5;     ///< see Pipeline::Options
};

/// What a bake did, for people and programs.
struct BakeSummary {
  struct Object {
    std::string name;
    std::size_t vertices = 0, triangles = 0;
    std::string repair;  ///< what was mended, in words
  };
  struct StageTime {
    std::string name, key;
    bool made = false;  ///< false: it was in the project
    double seconds = 0;
  };

  std::filesystem::path file;
  std::int64_t bytes = 0;
  bool resumed = false;            ///< work of an earlier bake was gone on with
  std::vector<std::string> notes;  ///< contradictions() of the recipe
  std::vector<Object> objects;
  std::vector<StageTime> stages;
  struct TransferFacts {
    std::string form;  ///< "none", "diffuse", "visibility", "matrix"
    int bands = 0, rays = 0, bounces = 0;
    std::size_t samples = 0, bytes = 0;
    double storageError = 0;  ///< relative, of rounding to the storage type
  };
  std::optional<TransferFacts> transfer;  ///< when it was made or found
  struct AtlasText {
    std::size_t charts = 0;
    double l2 = 0, lInf = 0, seam = 0, filled = 0;  ///< see AtlasFacts
  };
  std::optional<AtlasText> atlas;  ///< when it was made or found
  struct SynthesisFacts {
    std::size_t vertices = 0;                                               ///< of the meso mesh
    double patchWidth = 0, distance = 0, coherence = 0, longestRepeat = 0;  ///< see SynthesisQuality
  };
  std::optional<SynthesisFacts> synthesis;  ///< when a patch was laid over the surface
  std::optional<InterpolationFloor> floor;
  struct RttFacts {
    int texels = 0, views = 0, bands = 0, channels = 0, bounces = 0;
    double depth = 0;     ///< of the patch, relative to its width
    std::string warning;  ///< when it is too thick; empty: it is not
    double storageError = 0;
    std::optional<ViewError> viewError;  ///< of interpolating between views
    double seamStep = 1;                 ///< of an imported sample, see meso/rtt_seam.h
  };
  std::optional<RttFacts> rtt;  ///< when there is a patch
};

nlohmann::json toJson(const BakeSummary& summary);
/// "none", "diffuse", "visibility" or "matrix".
std::string toString(TransferForm form);

/// Bakes what is missing and saves. Throws FileError before any work when the output cannot be written;
/// Cancelled leaves the saved project as it was, and the work beside it for the next time.
BakeSummary bakeProject(const RecipeSource& source, const BakeOptions& options, Job& job,
                        PipelineListener* listener = nullptr);

}  // namespace prt
