#include "ui/model/bake_controller.h"

#include "libprt/core/error.h"
#include "libprt/project/recipe_table.h"

#include <nlohmann/json.hpp>

#include <QPointer>

#include <algorithm>
#include <mutex>
#include <set>

namespace prt::ui {

namespace {

bool covers(const std::string& section, const std::string& path) {
  return path == section || (path.starts_with(section) && path[section.size()] == '.');
}

// What the studio shows. What these are made from follows by itself.
const std::vector<std::string> kWanted{"mesh",  "scene", "samples", "transfer",
                                       "patch", "rtt",   "idmap",   "frames"};

const Stage& stageNamed(const std::string& name) {
  return *std::find_if(stages().begin(), stages().end(),
                       [&](const Stage& stage) { return stage.name == name; });
}

// The stage and all that it may be made from, in any order.
void collect(const std::string& name, QStringList& into) {
  const QString text = QString::fromStdString(name);
  if (into.contains(text)) return;
  into << text;
  for (const std::string& input : stageNamed(name).inputs) collect(input, into);
}

// Those and what they may be made from. Charts are baked only for a patch on the surface and for transfer at
// their texels: cutting must not stop other bakes.
bool isBakedHere(const Stage& stage) {
  static const std::set<std::string> needed = [] {
    QStringList all;
    for (const std::string& name : kWanted) collect(name, all);
    std::set<std::string> names;
    for (const QString& name : all) names.insert(name.toStdString());
    return names;
  }();
  return needed.contains(stage.name);
}

// What each stage and everything before it reads from the recipe, as text: equal texts, equal products
// as long as the files on disk stay the same.
std::map<std::string, std::string> readings(const Recipe& recipe) {
  Recipe plain = resolved(recipe);
  std::map<std::string, std::string> texts;
  forEachField(plain, [&](const FieldPlace& place, const FieldRef& field) {
    for (const Stage& stage : stages())
      for (const std::string& section : stage.reads)
        if (covers(section, place.parameter.path) && isBakedHere(stage))
          texts[stage.name] += place.path() + "=" + fieldToJson(field, place.parameter).dump() + "\n";
  });
  for (const Stage& stage : stages())
    if (stage.derives && isBakedHere(stage)) texts[stage.name] += stage.derives(plain) + "\n";
  for (const Stage& stage : stages())
    for (const std::string& input : stage.inputsFor(plain))
      if (isBakedHere(stage)) texts[stage.name] += "[" + input + "]" + texts[input];
  return texts;
}

// Whether two recipes differ in nothing that a stage reads, as far as can be told without making texts of
// them.
bool sameBake(const Recipe& a, const Recipe& b) {
  static const bool lightsMatter = [] {
    for (const Stage& stage : stages())
      for (const std::string& section : stage.reads)
        if (section.starts_with("lights") || section.starts_with("cameras") || section.starts_with("method"))
          return true;
    return false;
  }();
  return !lightsMatter && a.objects == b.objects && a.transfer == b.transfer && a.patch == b.patch &&
         a.layers == b.layers && a.rtt == b.rtt && a.charts == b.charts && a.atlas == b.atlas &&
         a.field == b.field && a.synthesis == b.synthesis && a.idmap == b.idmap &&
         a.method.name == b.method.name;
}

bool wantedBy(const Recipe& recipe, const std::string& stage) {
  return isWanted(stageNamed(stage), recipe);
}

// The stage and all that it is made from for a recipe.
QStringList withInputs(const std::string& name, const Recipe& recipe) {
  QStringList all{QString::fromStdString(name)};
  for (const std::string& input : stageNamed(name).inputsFor(recipe))
    for (const QString& each : withInputs(input, recipe))
      if (!all.contains(each)) all << each;
  return all;
}

// What a bake of this recipe makes: what the studio shows of it, and what that is made from.
QStringList stagesFor(const Recipe& recipe) {
  QStringList all;
  for (const std::string& name : kWanted)
    if (wantedBy(recipe, name))
      for (const QString& each : withInputs(name, recipe))
        if (!all.contains(each)) all << each;
  return all;
}

}  // namespace

// The job's thread may outlive the controller by the time the library takes to react to cancelling.
struct BakeController::Mailbox {
  std::mutex mutex;
  BakeController* owner;

  template <class Call>
  void post(Call call) {
    std::lock_guard lock(mutex);
    if (owner)
      QMetaObject::invokeMethod(
          owner, [o = owner, call] { call(*o); }, Qt::QueuedConnection);
  }
};

class BakeController::Listener : public PipelineListener {
 public:
  Listener(std::shared_ptr<Mailbox> mailbox, quint64 bake) : mailbox_(std::move(mailbox)), bake_(bake) {}

  void stageBegun(const Stage& stage) override {
    mailbox_->post([bake = bake_, name = nameOf(stage)](BakeController& c) { c.begun(bake, name); });
  }
  void stageDone(const Stage& stage, const ProductState& state, bool) override { pass(stage, state); }
  void preview(const Stage& stage, const ProductState& state) override { pass(stage, state); }

 private:
  static QString nameOf(const Stage& stage) { return QString::fromStdString(stage.name); }
  void pass(const Stage& stage, const ProductState& state) {
    mailbox_->post(
        [bake = bake_, name = nameOf(stage), state](BakeController& c) { c.arrived(bake, name, state); });
  }

  std::shared_ptr<Mailbox> mailbox_;
  quint64 bake_;
};

BakeController::BakeController(JobRunner& runner, QObject* parent)
    : QObject(parent), runner_(runner), mailbox_(std::make_shared<Mailbox>()) {
  mailbox_->owner = this;
  connect(&runner_, &JobRunner::retried, this, [this](quint64 failed, quint64 job) {
    if (failed == failedJob_) goOn(job);
  });
  for (const Stage& stage : stages())
    if (isBakedHere(stage))
      infos_.push_back(
          {QString::fromStdString(stage.name), QString::fromStdString(stage.makes), stage.stored});
}

BakeController::~BakeController() {
  cancel();
  std::lock_guard lock(mailbox_->mutex);
  mailbox_->owner = nullptr;
}

void BakeController::setBaker(std::shared_ptr<Baker> baker, const std::filesystem::path& folder) {
  cancel();
  baker_ = std::move(baker);
  folder_ = folder;
  seconds_ = 0;
  wanted_.clear();
  made_.clear();
  final_.clear();
  error_.clear();
  for (StageInfo& info : infos_) info.status = ProductStatus::Missing;
  Q_EMIT changed();
}

void BakeController::setRecipe(const Recipe& recipe) {
  if (!baker_) return;
  if (!wanted_.empty() && sameBake(recipe, recipe_)) {  // every move of a light comes by here
    recipe_ = recipe;
    return;
  }
  recipe_ = recipe;
  std::map<std::string, std::string> wanted = readings(recipe);
  const QStringList needed = stagesFor(recipe);
  bool otherStages = false;
  for (StageInfo& info : infos_) {
    const bool now = needed.contains(info.name);
    otherStages = std::exchange(info.wanted, now) != now || otherStages;
  }
  if (wanted == wanted_ && !otherStages) return;
  wanted_ = std::move(wanted);
  cancel();
  refreshStale();
  if (automatic_ && !fresh()) start();
}

void BakeController::moveTo(const std::filesystem::path& folder, const Recipe& recipe) {
  folder_ = folder;
  recipe_ = recipe;
  std::map<std::string, std::string> wanted = readings(recipe);
  for (auto& [stage, made] : made_)
    if (made == wanted_[stage]) made = wanted[stage];
  wanted_ = std::move(wanted);
}

double BakeController::bakedSeconds() const {
  return seconds_ + (clock_.isValid() ? 1e-3 * double(clock_.elapsed()) : 0.0);
}

void BakeController::stopClock() {
  seconds_ = bakedSeconds();
  clock_.invalidate();
}

void BakeController::bake() {
  if (baker_ && !baking()) start();
}

void BakeController::cancel() {
  if (!baking()) return;
  const quint64 job = job_;
  ++bake_;  // whatever still comes from it is not wanted
  job_ = 0;
  stopClock();
  for (StageInfo& info : infos_)
    if (info.status == ProductStatus::Baking) info.status = ProductStatus::Stale;
  runner_.cancel(job);
  Q_EMIT changed();
}

void BakeController::setAutomatic(bool automatic) {
  automatic_ = automatic;
  if (automatic && !fresh()) bake();
}

bool BakeController::fresh() const {
  return std::all_of(infos_.begin(), infos_.end(),
                     [](const StageInfo& i) { return !i.wanted || i.status == ProductStatus::Fresh; });
}

ProductStatus BakeController::worstStatus(const QStringList& names) const {
  constexpr ProductStatus kOrder[] = {ProductStatus::Failed, ProductStatus::Preview, ProductStatus::Baking,
                                      ProductStatus::Stale, ProductStatus::Missing};
  for (const ProductStatus status : kOrder)
    for (const StageInfo& info : infos_)
      if (info.wanted && info.status == status && names.contains(info.name)) return status;
  return ProductStatus::Fresh;
}

void BakeController::start() {
  const quint64 bake = ++bake_;
  std::vector<std::string> targets;
  for (const std::string& name : kWanted)
    if (wantedBy(recipe_, name)) targets.push_back(name);
  const auto work = [baker = baker_, folder = folder_, recipe = recipe_, targets, mailbox = mailbox_,
                     bake](Job& job) {
    Listener listener(mailbox, bake);
    baker->pipeline.setFolder(folder);
    baker->pipeline.run(recipe, targets, job, &listener);
    baker->store.keepRecent(baker->pipeline.liveKeys(recipe), kKeptForUndo, job);
  };
  const auto finish = [self = QPointer(this), bake](const JobInfo& job) {
    if (self) self->ended(bake, job);
  };
  goOn(runner_.start(QStringLiteral("bake"), tr("Bake transfer"), work, finish));
}

void BakeController::goOn(quint64 job) {
  job_ = job;
  failedJob_ = 0;
  error_.clear();
  clock_.start();
  Q_EMIT changed();
}

void BakeController::begun(quint64 bake, const QString& stage) {
  if (bake != bake_) return;
  infoOf(stage)->status = ProductStatus::Baking;
  Q_EMIT changed();
}

void BakeController::arrived(quint64 bake, const QString& stage, const ProductState& state) {
  if (bake != bake_) return;
  StageInfo& info = *infoOf(stage);
  info.status = state.final() ? ProductStatus::Fresh : ProductStatus::Preview;
  info.level = state.level;
  info.levels = state.levels;
  if (state.final()) {
    final_[stage.toStdString()] = state;
    // What it was made from is as good as made, even where the project had the result and nobody asked.
    for (const QString& each : withInputs(stage.toStdString(), recipe_)) {
      infoOf(each)->status = ProductStatus::Fresh;
      made_[each.toStdString()] = wanted_[each.toStdString()];
    }
  }
  Q_EMIT productArrived(stage, state);
  Q_EMIT changed();
}

void BakeController::ended(quint64 bake, const JobInfo& job) {
  if (bake != bake_) return;
  job_ = 0;
  stopClock();
  for (StageInfo& info : infos_) {
    const bool unfinished = info.status == ProductStatus::Baking;
    if (unfinished)
      info.status = job.state == JobState::Failed ? ProductStatus::Failed : ProductStatus::Stale;
  }
  if (job.state == JobState::Failed) {
    error_ = job.error;
    failedJob_ = job.id;
    Q_EMIT failed(job.error);
  }
  Q_EMIT changed();
}

// Which products no longer are what the recipe asks for.
void BakeController::refreshStale() {
  for (StageInfo& info : infos_) {
    const auto made = made_.find(info.name.toStdString());
    const bool same = made != made_.end() && made->second == wanted_.at(info.name.toStdString());
    if (same)
      info.status = ProductStatus::Fresh;
    else if (info.status != ProductStatus::Missing)
      info.status = ProductStatus::Stale;
  }
  Q_EMIT changed();
}

StageInfo* BakeController::infoOf(const QString& stage) {
  return &*std::find_if(infos_.begin(), infos_.end(),
                        [&](const StageInfo& info) { return info.name == stage; });
}

}  // namespace prt::ui
