#include "ui/model/project_keeper.h"

#include "libprt/core/error.h"
#include "libprt/project/scenes.h"
#include "ui/model/project_save.h"

#include <QFileInfo>
#include <QSettings>

#include <utility>

namespace prt::ui {

namespace {

namespace fs = std::filesystem;

const QString kBackups = QStringLiteral("documents/backups");
const QString kAutosave = QStringLiteral("documents/autosave");

QString text(const fs::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace

ProjectKeeper::ProjectKeeper(Document& document, BakeController& bakes, JobRunner& jobs, Log& log,
                             QObject* parent)
    : QObject(parent),
      document_(document),
      bakes_(bakes),
      jobs_(jobs),
      log_(log),
      autosave_(document, [this] { return unsaved().any(); }) {
  autosave_.setMilliseconds(1000 * autosaveSeconds());
  connect(&autosave_, &Autosave::failed, this, &ProjectKeeper::failed);
}

ProjectKeeper::~ProjectKeeper() {
  autosave_.flush();
  if (givenUp_) dismissPlace();
  autosave_.setPlace(nullptr);
  if (titled_ && file_ && !file_->hasNewWork()) file_->discardWork();  // all of it is saved
}

int ProjectKeeper::backups() {
  return QSettings().value(kBackups, 3).toInt();
}

void ProjectKeeper::setBackups(int count) {
  QSettings().setValue(kBackups, count);
}

int ProjectKeeper::autosaveSeconds() {
  return QSettings().value(kAutosave, 10).toInt();
}

void ProjectKeeper::setAutosaveSeconds(int seconds) {
  QSettings().setValue(kAutosave, seconds);
  autosave_.setMilliseconds(1000 * seconds);
}

// ---- what would be lost ----

Unsaved ProjectKeeper::unsaved() const {
  Unsaved what{document_.title(), document_.editsSinceSave(), document_.modified() || recovered_};
  const double seconds = bakes_.bakedSeconds();
  if (!titled_ && (seconds >= kWorthAsking || recovered_)) what.bakedSeconds = seconds;
  what.bakeGoesOn = titled_ && bakes_.baking();
  return what;
}

void ProjectKeeper::leaveThen(std::function<void()> go) {
  if (saving_) {  // it may be all that is asked for
    afterSaving_ = [this, go] { leaveThen(go); };
    return;
  }
  const Unsaved what = unsaved();
  if (!what.any() || !ask_) return go();
  const LeaveAnswer answer = ask_(what);
  if (answer.leave == Leave::Discard) go();
  if (answer.leave == Leave::Save)
    saveThen(answer.path, [go](bool done) {
      if (done) go();
    });
}

void ProjectKeeper::dismissPlace() {
  if (place_) place_->dismiss();
}

// ---- opening ----

void ProjectKeeper::open(const QString& what) {
  const bool builtin = what.startsWith(u"scene:") || what.startsWith(u"builtin:");
  const QString file = builtin ? what : QFileInfo(what).absoluteFilePath();
  leaveThen([this, file, name = QFileInfo(what).fileName()] {
    start({file, titled_ ? file_ : nullptr, recoveryRoot_, nullptr}, tr("Open %1").arg(name));
  });
}

void ProjectKeeper::start(const OpenRequest& request, const QString& title) {
  auto result = std::make_shared<OpenedProject>();
  const auto work = [request, result](Job& job) { *result = openProject(request, job); };
  const auto finish = [this, result](const JobInfo& job) {
    opening_ = false;
    if (job.state == JobState::Done)
      adopt(*result);
    else if (job.state == JobState::Failed)
      Q_EMIT failed(job.error);
    *result = {};  // the job may be remembered; what it brought is not
    Q_EMIT statusChanged();
  };
  opening_ = true;
  jobs_.start(QStringLiteral("open"), title, work, finish);
  Q_EMIT statusChanged();
}

void ProjectKeeper::adopt(const OpenedProject& opened) {
  if (place_ != opened.place) dismissPlace();
  ++documentNumber_;
  afterSaving_ = {};
  saving_ = false;
  file_ = opened.file;
  titled_ = !opened.path.isEmpty();
  place_ = opened.place;
  recovered_ = opened.recovered.has_value();
  links_ = opened.links;
  Q_EMIT leaving();
  bakes_.setBaker(opened.baker, opened.folder);
  document_.open(opened.saved, opened.path);
  if (opened.recovered) document_.edit(tr("Recovered edits"), *opened.recovered);
  autosave_.setPlace(place_);
  if (titled_) recent_.add(opened.path);
  log_.add(Severity::Info, tr("Opened %1").arg(document_.title()));
  if (opened.resumed) log_.add(Severity::Info, tr("Baked work of the last time that was not saved goes on."));
  if (!opened.warning.empty()) log_.add(Severity::Warning, QString::fromStdString(opened.warning));
  if (!opened.problem.empty()) Q_EMIT failed(QString::fromStdString(opened.problem));
  Q_EMIT linksChanged();
}

// ---- saving ----

void ProjectKeeper::saveThen(const QString& path, std::function<void(bool)> then) {
  const QString file = QFileInfo(path).absoluteFilePath();
  const Recipe snapshot = document_.recipe();
  auto request = std::make_shared<SaveRequest>();
  request->file = file.toStdString();
  request->recipe = document_.movedTo(file, snapshot);
  request->backups = backups();
  request->baker = bakes_.baker();
  request->store = file_;
  if (!file_) request->products = bakes_.finalProducts();
  auto store = std::make_shared<std::shared_ptr<ProjectFile>>();
  const auto work = [request, store](Job& job) { *store = saveProject(*request, job); };
  const auto finish = [this, then, file, snapshot, store, number = documentNumber_](const JobInfo& job) {
    const bool ours = number == documentNumber_, done = job.state == JobState::Done;
    if (ours) saving_ = false;
    if (job.state == JobState::Failed) Q_EMIT failed(job.error);
    if (ours && done) settle(file, snapshot, std::exchange(*store, {}));
    store->reset();
    if (then) then(ours && done);
    if (ours && afterSaving_) std::exchange(afterSaving_, {})();
  };
  saving_ = true;
  jobs_.start(QStringLiteral("save"), tr("Save %1").arg(QFileInfo(path).fileName()), work, finish);
}

// What follows from a save: `snapshot` is in the file, and the document may have gone on since.
void ProjectKeeper::settle(const QString& path, const Recipe& snapshot, std::shared_ptr<ProjectFile> file) {
  const bool moved = file != file_;
  file_ = std::move(file);
  titled_ = true;
  recovered_ = false;
  bakes_.moveTo(file_->file().parent_path(), document_.movedTo(path, document_.recipe()));
  document_.markSaved(path, snapshot);
  if (moved && place_) {
    dismissPlace();  // its products are in the project now
    try {
      place_ = RecoveryPlace::create(recoveryRoot_);
    } catch (const Error& error) {
      place_.reset();
      log_.add(Severity::Warning, QString::fromUtf8(error.what()));
    }
    autosave_.setPlace(place_);
  }
  autosave_.write();
  recent_.add(path);
  log_.add(Severity::Info, tr("Saved %1").arg(document_.title()));
  if (bakes_.automatic() && !bakes_.fresh()) bakes_.bake();
  Q_EMIT saved(path);
}

void ProjectKeeper::collect() {
  if (!titled_) return;
  const fs::path project = document_.path().toStdString();
  const fs::path files = project.parent_path() / (project.stem().string() + "_files");
  auto recipe = std::make_shared<Recipe>(document_.recipe());
  const auto work = [recipe, files, folder = document_.folder()](Job& job) {
    collectFiles(*recipe, folder, files, folder, job);
  };
  const auto finish = [this, recipe, files, before = document_.recipe()](const JobInfo& job) {
    if (job.state == JobState::Failed) Q_EMIT failed(job.error);
    if (job.state != JobState::Done) return;
    if (document_.recipe() != before)
      return failed(tr("The project was edited meanwhile: collect it again."));
    document_.edit(tr("Collect files"), *recipe);
    save(document_.path());
    Q_EMIT notice(tr("Everything that the project uses is in %1 now.").arg(text(files)));
  };
  jobs_.start(QStringLiteral("collect"), tr("Collect files"), work, finish);
}

// ---- recovery ----

const std::vector<std::shared_ptr<RecoveryPlace>>& ProjectKeeper::recoveries() {
  if (recoveries_) return *recoveries_;
  recoveries_ = RecoveryPlace::orphans(recoveryRoot_);
  std::erase_if(*recoveries_, [](const auto& place) {
    const auto entry = place->read();
    bool saved = false;  // died between a save and forgetting what it had saved
    try {
      saved = entry && !entry->path.isEmpty() &&
              ProjectFile::open(entry->path.toStdString())->recipe() == entry->recipe;
    } catch (const Error&) {  // gone or damaged: what is kept is all the more worth
    }
    if (saved) place->dismiss();
    return saved;
  });
  return *recoveries_;
}

void ProjectKeeper::restore(const std::shared_ptr<RecoveryPlace>& place) {
  leaveThen([this, place] {
    std::erase(*recoveries_, place);
    start({{}, titled_ ? file_ : nullptr, recoveryRoot_, place}, tr("Restore"));
    Q_EMIT recoveriesChanged();
  });
}

void ProjectKeeper::discard(const std::shared_ptr<RecoveryPlace>& place) {
  place->dismiss();
  std::erase(*recoveries_, place);
  Q_EMIT recoveriesChanged();
}

// ---- files that moved ----

void ProjectKeeper::searchLinks(const QString& folder) {
  std::vector<LinkedFile> missing = links_;
  std::erase_if(missing, [](const LinkedFile& link) { return link.state != LinkState::Missing; });
  auto found = std::make_shared<std::map<std::string, FoundFile>>();
  const auto work = [found, missing, folder](Job& job) {
    *found = findMoved(missing, folder.toStdString(), job);
  };
  const auto finish = [this, found](const JobInfo& job) {
    if (job.state == JobState::Failed) Q_EMIT failed(job.error);
    if (job.state == JobState::Done) Q_EMIT linksFound(*found);
  };
  jobs_.start(QStringLiteral("search"), tr("Search %1").arg(folder), work, finish);
}

void ProjectKeeper::relink(const std::map<std::string, fs::path>& files) {
  Recipe next = document_.recipe();
  for (const auto& [path, file] : files)
    ::prt::relink(next, path, file.lexically_relative(document_.folder()).generic_string());
  std::erase_if(links_, [&](const LinkedFile& link) { return files.contains(link.path); });
  document_.edit(tr("Relink %n files", nullptr, int(files.size())), next);
  Q_EMIT linksChanged();
}

}  // namespace prt::ui
