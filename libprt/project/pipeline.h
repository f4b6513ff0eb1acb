#pragma once
// Runs the stage table: finds what the project already holds, makes what is missing, hands out previews.
//
// Keys. key(stage) = hash of its name and version, the values that it reads (`auto` resolved, contents
// of files hashed, values without effect left out) and the keys of its inputs. Products live under
// their key, so undo finds the old product again, and editing one material runs only what read it.

#include "libprt/project/stages.h"

#include <map>
#include <set>

namespace prt {

/// Called on the thread that runs the pipeline; must be quick and must not throw.
class PipelineListener {
 public:
  virtual ~PipelineListener() = default;
  virtual void stageBegun(const Stage&) {}
  /// `made`: false when it was found in the project.
  virtual void stageDone(const Stage&, const ProductState&, bool /*made*/) {}
  virtual void preview(const Stage&, const ProductState&) {}
  /// Without a listener that wants them no previews are made.
  virtual bool wantsPreviews() const { return true; }
};

/// The products of a run, by stage.
class Products {
 public:
  /// The product as the type it has; null when the stage was not run.
  template <class T>
  std::shared_ptr<const T> get(const std::string& stage) const {
    const auto found = states.find(stage);
    return found == states.end() ? nullptr : std::dynamic_pointer_cast<const T>(found->second.product);
  }
  const ProductState* state(const std::string& stage) const {
    const auto found = states.find(stage);
    return found == states.end() ? nullptr : &found->second;
  }

  std::map<std::string, ProductState> states;
};

/// Whether two runs would make the same: what `auto` stands for put in its place, and settings that have
/// no effect (detail of a mesh from a file, exponent of a Lambert surface) at their defaults.
Recipe resolved(const Recipe& recipe);
/// What the recipe asks for and does not get because another of its settings excludes it: one line each, for
/// the user.
std::vector<std::string> contradictions(const Recipe& recipe);

class Pipeline {
 public:
  struct Options {
    std::filesystem::path folder = ".";  ///< relative paths of the recipe start here
    double checkpointSeconds = 5;  ///< least time between checkpoints, never over 10 % of a run; 0 = no limit
    /// How long a cancelled run may go on writing previews and checkpoints; 0 = until they are written. What
    /// does not fit is given up: the last checkpoint and what was stored before stay.
    double lastWriteSeconds = 0;
  };

  /// `store` may be null: nothing outlives this object then. Keeps references to store and table.
  Pipeline(ProductStore* store, Options options, const std::vector<Stage>& table = stages());

  /// Where relative paths start from the next run on: for a project that moved.
  void setFolder(const std::filesystem::path& folder) { options_.folder = folder; }

  /// Products of the targets and of everything they were made from, all final. One run at a time per
  /// object. Throws what stages throw; Cancelled leaves checkpoints and previews in the store.
  Products run(const Recipe& recipe, const std::vector<std::string>& targets, Job& job,
               PipelineListener* listener = nullptr);

  /// Whatever the store has, without making anything: final products, else previews, else nothing.
  Products find(const Recipe& recipe, const std::vector<std::string>& targets);

  /// Keys of all stages. Reads and hashes the source files; throws FileError when one is missing and the
  /// store has not seen it.
  std::map<std::string, std::string> keys(const Recipe& recipe);
  /// Keys of all products and of all checkpoints that serve this recipe.
  std::set<std::string> liveKeys(const Recipe& recipe);

 private:
  friend class PipelineRun;

  std::string sourceHash(const std::string& path);

  ProductStore* store_;
  Options options_;
  const std::vector<Stage>& table_;
  std::map<std::string, ProductState> cache_;  // the last final product of each stage
};

}  // namespace prt
