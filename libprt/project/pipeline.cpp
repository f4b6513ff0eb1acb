#include "libprt/project/pipeline.h"

#include "libprt/core/error.h"
#include "libprt/core/hash.h"
#include "libprt/project/recipe_table.h"
#include "libprt/project/source_hash.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace prt {
namespace {

using Clock = std::chrono::steady_clock;

/// A recipe's values as "path=value", under the pattern path of each: what keys are made from.
struct Value {
  std::string pattern, text;
};

bool covers(const std::string& section, const std::string& pattern) {
  return pattern == section || (pattern.starts_with(section) && pattern[section.size()] == '.');
}

bool coversAny(const std::vector<std::string>& sections, const std::string& pattern) {
  return std::any_of(sections.begin(), sections.end(),
                     [&](const std::string& s) { return covers(s, pattern); });
}

const Stage& stageNamed(const std::vector<Stage>& table, const std::string& name) {
  for (const Stage& stage : table)
    if (stage.name == name) return stage;
  std::vector<std::string> names;
  for (const Stage& stage : table) names.push_back(stage.name);
  std::string list;
  for (const std::string& n : names) list += (list.empty() ? "use " : ", ") + n;
  throw ValueError("there is no stage '" + name + "'", "", list);
}

std::string keyOf(const Stage& stage, const Recipe& recipe, const std::vector<Value>& values,
                  const std::map<std::string, std::string>& keys, const std::vector<std::string>& without) {
  Hasher hasher;
  hasher.add(stage.name).add(stage.version);
  for (const Value& value : values)
    if (coversAny(stage.reads, value.pattern) && !coversAny(without, value.pattern)) hasher.add(value.text);
  if (const std::string text = stage.derives ? stage.derives(recipe) : std::string(); !text.empty())
    hasher.add(text);
  for (const std::string& input : stage.inputsFor(recipe)) hasher.add(keys.at(input));
  return hasher.result().hex();
}

}  // namespace

/// One run of a pipeline.
class PipelineRun {
 public:
  PipelineRun(Pipeline& pipeline, const Recipe& recipe, Job& job, PipelineListener* listener)
      : pipeline_(pipeline),
        recipe_(resolved(recipe)),
        job_(job),
        listener_(listener),
        values_(readValues()) {
    for (const Stage& stage : table()) keys_[stage.name] = keyOf(stage, recipe_, values_, keys_, {});
  }

  const std::map<std::string, std::string>& keys() const { return keys_; }
  std::string checkpointKey(const Stage& stage) const {
    return keyOf(stage, recipe_, values_, keys_, stage.extends);
  }

  Products make(const std::vector<std::string>& targets) {
    for (const std::string& target : targets) wanted_.insert(stageNamed(table(), target).name);
    for (const std::string& target : targets) need(stageNamed(table(), target));
    return {std::move(states_)};
  }

  Products find(const std::vector<std::string>& targets) {
    for (const std::string& target : targets) findOrDerive(stageNamed(table(), target));
    return {std::move(states_)};
  }

 private:
  class Run;
  using State = ProductState;

  const std::vector<Stage>& table() const { return pipeline_.table_; }

  std::vector<Value> readValues();
  const State& need(const Stage& stage);
  std::optional<State> existing(const Stage& stage);
  bool findOrDerive(const Stage& stage);
  void runStage(const Stage& stage);
  void finish(const Stage& stage, State state, bool made);
  void announce(const Stage& stage, State state);
  void makePreviewsAfter(const Stage& stage);
  bool isInput(const Stage& stage, const Stage& user) const;
  bool leadsToTarget(const Stage& stage) const;
  void keepPreviews();
  ProductStore::WriteCheck writeCheck();
  void store(const Stage& stage, const State& state);

  Pipeline& pipeline_;
  Recipe recipe_;
  Job& job_;
  PipelineListener* listener_;
  std::vector<Value> values_;
  std::map<std::string, std::string> keys_;
  std::map<std::string, State> states_;
  std::set<std::string> wanted_;
  std::optional<Clock::time_point> lastWrite_;  // from which on a cancelled run writes nothing more
};

/// What a stage's function sees of the run.
class PipelineRun::Run : public StageRun {
 public:
  Run(PipelineRun& run, const Stage& stage, bool previewing)
      : run_(run), stage_(stage), previewing_(previewing), written_(Clock::now()) {
    checkpointKey_ = run.checkpointKey(stage);
  }

  const Recipe& recipe() const override { return run_.recipe_; }
  std::filesystem::path file(const std::string& path) const override {
    return run_.pipeline_.options_.folder / path;
  }
  Job& job() override { return run_.job_; }
  const ProductState& inputState(const std::string& stage) const override { return run_.states_.at(stage); }
  bool fromPreview() const override { return previewing_; }
  bool wantsPreviews() const override {
    return run_.listener_ && run_.listener_->wantsPreviews() && !previewing_;
  }

  void preview(ProductPtr product, int level, int levels) override {
    if (previewing_) return;
    run_.announce(stage_, {std::move(product), run_.keys_.at(stage_.name), level, levels});
    run_.makePreviewsAfter(stage_);
  }

  std::unique_ptr<ProductData> checkpoint() const override {
    ProductStore* store = run_.pipeline_.store_;
    auto saved = store && !previewing_ ? store->findCheckpoint(stage_.name, checkpointKey_) : nullptr;
    stored_ = stored_ || saved;
    return saved;
  }

  bool checkpointDue() const override {
    if (!run_.pipeline_.store_ || previewing_) return false;
    const double every = run_.pipeline_.options_.checkpointSeconds;
    const auto since = Clock::now() - written_;
    return every <= 0 || (since >= std::chrono::duration<double>(every) && since >= 9 * cost_);
  }

  void keepCheckpoint(const std::function<ProductData()>& save) override {
    ProductStore* store = run_.pipeline_.store_;
    if (!store || previewing_) return;
    const auto before = Clock::now();
    store->putCheckpoint(stage_.name, checkpointKey_, save(), run_.writeCheck());
    written_ = Clock::now();
    cost_ = written_ - before;
    stored_ = true;
  }

  /// Once the product is there.
  void dropCheckpoint() {
    if (stored_ && stage_.extends.empty()) run_.pipeline_.store_->dropCheckpoint(stage_.name, checkpointKey_);
  }

 private:
  PipelineRun& run_;
  const Stage& stage_;
  bool previewing_;
  Clock::time_point written_;
  Clock::duration cost_{0};
  mutable bool stored_ = false;  // a checkpoint is in the store
  std::string checkpointKey_;
};

std::vector<Value> PipelineRun::readValues() {
  std::vector<Value> values;
  forEachField(recipe_, [&](const FieldPlace& place, const FieldRef& field) {
    const Parameter& p = place.parameter;
    const bool read = std::any_of(table().begin(), table().end(),
                                  [&](const Stage& s) { return coversAny(s.reads, p.path); });
    if (!read) return;
    std::string text = fieldToJson(field, p).dump();
    if (p.type == ParameterType::File) {
      const std::string& path = *std::get<std::string*>(field);
      if (!path.empty() && !isBuiltin(path)) text = pipeline_.sourceHash(path);
    }
    values.push_back({p.path, place.path() + "=" + text});
  });
  return values;
}

std::optional<ProductState> PipelineRun::existing(const Stage& stage) {
  const std::string& key = keys_.at(stage.name);
  const auto cached = pipeline_.cache_.find(stage.name);
  if (cached != pipeline_.cache_.end() && cached->second.key == key) return cached->second;
  if (!pipeline_.store_ || !stage.stored) return {};
  const auto stored = pipeline_.store_->find(stage.name, key);
  if (!stored) return {};
  return ProductState{stage.load(std::move(stored->data)), key, stored->level, stored->levels};
}

const ProductState& PipelineRun::need(const Stage& stage) {
  const auto done = states_.find(stage.name);
  if (done != states_.end() && done->second.final()) return done->second;
  job_.checkCancelled();
  const auto found = existing(stage);
  if (found && found->final()) {
    finish(stage, *found, false);
  } else {
    for (const std::string& input : stage.inputsFor(recipe_)) need(stageNamed(table(), input));
    if (found) announce(stage, *found);
    runStage(stage);
  }
  return states_.at(stage.name);
}

/// What is there; products that are never stored are made if what they need is there.
bool PipelineRun::findOrDerive(const Stage& stage) {
  if (states_.contains(stage.name)) return true;
  if (auto state = existing(stage)) {
    states_[stage.name] = *state;
    return true;
  }
  if (stage.stored) return false;
  for (const std::string& input : stage.inputsFor(recipe_))
    if (!findOrDerive(stageNamed(table(), input))) return false;
  runStage(stage);
  return true;
}

void PipelineRun::runStage(const Stage& stage) {
  if (listener_) listener_->stageBegun(stage);
  Run run(*this, stage, false);
  ProductPtr product;
  try {
    product = stage.make(run);
  } catch (const Cancelled&) {
    keepPreviews();
    throw;
  }
  finish(stage, {std::move(product), keys_.at(stage.name), 1, 1}, true);
  run.dropCheckpoint();
}

void PipelineRun::finish(const Stage& stage, State state, bool made) {
  if (made && pipeline_.store_ && stage.stored) job_.begin("writing", 0);
  if (made) store(stage, state);
  pipeline_.cache_[stage.name] = state;
  const State& kept = states_[stage.name] = std::move(state);
  if (listener_) listener_->stageDone(stage, kept, made);
}

void PipelineRun::announce(const Stage& stage, State state) {
  const State& kept = states_[stage.name] = std::move(state);
  if (listener_) listener_->preview(stage, kept);
}

bool PipelineRun::isInput(const Stage& stage, const Stage& user) const {
  const std::vector<std::string> inputs = user.inputsFor(recipe_);
  return std::find(inputs.begin(), inputs.end(), stage.name) != inputs.end();
}

bool PipelineRun::leadsToTarget(const Stage& stage) const {
  if (wanted_.contains(stage.name)) return true;
  return std::any_of(table().begin(), table().end(),
                     [&](const Stage& user) { return isInput(stage, user) && leadsToTarget(user); });
}

/// Makes previews of the stages behind `stage` that somebody asked for, as far as their inputs are there.
void PipelineRun::makePreviewsAfter(const Stage& stage) {
  for (const Stage& user : table()) {
    if (!isInput(stage, user) || !user.previews || !leadsToTarget(user)) continue;
    for (const std::string& input : user.inputsFor(recipe_))
      if (!states_.contains(input)) need(stageNamed(table(), input));
    Run run(*this, user, true);
    const State& input = states_.at(stage.name);
    announce(user, {user.make(run), keys_.at(user.name), input.level, input.levels});
    makePreviewsAfter(user);
  }
}

/// A cancelled run leaves its best pictures behind.
void PipelineRun::keepPreviews() {
  for (const Stage& stage : table()) {
    const auto state = states_.find(stage.name);
    if (state != states_.end() && !state->second.final()) store(stage, state->second);
  }
}

/// Ends writes of a cancelled run once its time for them is over.
ProductStore::WriteCheck PipelineRun::writeCheck() {
  const double most = pipeline_.options_.lastWriteSeconds;
  if (most <= 0) return {};
  return [this, most] {
    if (!job_.cancelled()) return;
    const auto now = Clock::now();
    if (!lastWrite_)
      lastWrite_ = now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(most));
    if (now >= *lastWrite_) throw Cancelled();
  };
}

void PipelineRun::store(const Stage& stage, const State& state) {
  if (pipeline_.store_ && stage.stored)
    pipeline_.store_->put(stage.name, state.key, {state.product->save(), state.level, state.levels},
                          writeCheck());
}

Pipeline::Pipeline(ProductStore* store, Options options, const std::vector<Stage>& table)
    : store_(store), options_(std::move(options)), table_(table) {}

Products Pipeline::run(const Recipe& recipe, const std::vector<std::string>& targets, Job& job,
                       PipelineListener* listener) {
  return PipelineRun(*this, recipe, job, listener).make(targets);
}

Products Pipeline::find(const Recipe& recipe, const std::vector<std::string>& targets) {
  Job job;
  return PipelineRun(*this, recipe, job, nullptr).find(targets);
}

std::map<std::string, std::string> Pipeline::keys(const Recipe& recipe) {
  Job job;
  return PipelineRun(*this, recipe, job, nullptr).keys();
}

std::set<std::string> Pipeline::liveKeys(const Recipe& recipe) {
  Job job;
  const PipelineRun run(*this, recipe, job, nullptr);
  std::set<std::string> live;
  for (const Stage& stage : table_) live.insert({run.keys().at(stage.name), run.checkpointKey(stage)});
  return live;
}

std::string Pipeline::sourceHash(const std::string& path) {
  const std::filesystem::path file = options_.folder / path;
  std::error_code error;
  if (store_ && !std::filesystem::exists(file, error))
    if (std::string known = store_->sourceHash(path); !known.empty()) return known;
  const std::string hash = hashSource(file);
  if (store_) store_->putSourceHash(path, hash);
  return hash;
}

}  // namespace prt
