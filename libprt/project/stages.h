#pragma once
// The whole pipeline in one table: begin reading at stages() in stages.cpp.
//
// A stage is a pure function from its inputs (products of other stages) and the parts of the recipe that
// it reads to one product. Its key is a hash of exactly these, so it runs only when one of them changed.
//
//   mesh ─> scene ─┬─> samples ─┬─> direct ─> transfer ─┐
//                  ├─> rays ────┘                       ├─> relight
//            (field) ─> frames ─────────────────────────┘
//   scene ─> charts ─> atlas ─────────────────────┬─> idmap
//   scene ─> field ─> frames ─┬─> synthesis ──────┘
//   patch ─> rtt, layers ─────┘
//
// Where transfer is at texels, atlas ─> samples too.

#include "libprt/core/job.h"
#include "libprt/project/product.h"
#include "libprt/project/recipe.h"

#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace prt {

/// What a stage's function sees.
class StageRun {
 public:
  virtual ~StageRun() = default;

  /// The recipe, everything `auto` resolved. Read only what the table says.
  virtual const Recipe& recipe() const = 0;
  /// A file path of the recipe made absolute.
  virtual std::filesystem::path file(const std::string& path) const = 0;
  virtual Job& job() = 0;

  /// The product of an input stage, as the type it has.
  template <class T>
  std::shared_ptr<const T> input(const std::string& stage) const {
    return std::dynamic_pointer_cast<const T>(inputState(stage).product);
  }
  virtual const ProductState& inputState(const std::string& stage) const = 0;
  /// True when an input is a preview: the result will be one too.
  virtual bool fromPreview() const = 0;

  /// Hands out an unfinished product, level of levels. Later stages make previews of their own from it
  /// before this returns.
  virtual void preview(ProductPtr product, int level, int levels) = 0;
  /// Whether anybody wants previews: without a watcher they are work for nothing.
  virtual bool wantsPreviews() const = 0;

  /// Work that an earlier run left, or nothing. Its key leaves out what Stage::extends lists.
  virtual std::unique_ptr<ProductData> checkpoint() const = 0;
  /// Whether it is time to write a state that a later run can go on from. Thread-safe and quick.
  virtual bool checkpointDue() const = 0;
  /// Writes one; `save` is not called when there is nowhere to write. Do so when it is due, when cancelled,
  /// and at the end where more can be added later (Stage::extends; else it is dropped with the end of the
  /// stage).
  virtual void keepCheckpoint(const std::function<ProductData()>& save) = 0;
};

struct Stage {
  std::string name;
  std::string makes;                     ///< one line for people
  int version = 1;                       ///< raised when the same inputs give another product
  std::vector<std::string> inputs = {};  ///< stages
  /// For inputs that only some recipes need: which. Others are always needed.
  std::map<std::string, std::function<bool(const Recipe&)>> onlyFor = {};
  /// Recipe paths, or sections meaning all paths in them: "objects[].mesh", "transfer.bands".
  std::vector<std::string> reads = {};
  /// Of `reads`, those of which more only extends the work: a checkpoint serves any value of them.
  std::vector<std::string> extends = {};
  /// Further text for the key, worked out from the recipe: when only a consequence of settings matters.
  /// Empty: none.
  std::function<std::string(const Recipe&)> derives = {};
  /// Whether a bake of everything makes it; absent: always.
  std::function<bool(const Recipe&)> wanted = {};
  bool stored = true;    ///< kept in the project; false for what is quicker made than read
  bool previews = true;  ///< quick enough to be run on every preview of its inputs
  std::function<ProductPtr(StageRun&)> make = {};
  std::function<ProductPtr(ProductData)> load = {};  ///< throws FileError when the data cannot be right

  /// The inputs that a recipe needs.
  std::vector<std::string> inputsFor(const Recipe& recipe) const;
};

/// The pipeline, inputs before users.
const std::vector<Stage>& stages();

/// Whether a bake of everything makes the stage's product, be it for another stage.
bool isWanted(const Stage& stage, const Recipe& recipe);

/// Names of all stages; for --stage.
std::vector<std::string> stageNames();

}  // namespace prt
