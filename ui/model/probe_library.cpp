#include "ui/model/probe_library.h"

#include "libprt/core/error.h"
#include "libprt/light/built_in_skies.h"
#include "libprt/light/environment_io.h"
#include "ui/model/probe_picture.h"

#include <QFileInfo>
#include <QPointer>

#include <mutex>

namespace prt::ui {

namespace {

const QString kBuiltin = QStringLiteral("builtin:");

// Small built-in maps are made in a moment; a little finer than the picture, so that letters stay legible.
EnvironmentMap mapOf(const QString& path) {
  if (path.startsWith(kBuiltin))
    return builtInSky(path.mid(kBuiltin.size()).toStdString(), 2 * ProbeLibrary::kPictureWidth,
                      2 * ProbeLibrary::kPictureHeight);
  return loadEnvironment(path.toStdString());
}

}  // namespace

ProbeLibrary::ProbeLibrary(JobRunner& runner, QObject* parent) : QObject(parent), runner_(runner) {
  rebuild();
}

void ProbeLibrary::wantPictures() {
  wanted_ = true;
  makePictures();
}

void ProbeLibrary::setProject(const QStringList& paths) {
  if (paths == project_) return;
  project_ = paths;
  rebuild();
}

void ProbeLibrary::setRecent(const QStringList& paths) {
  recent_ = paths.mid(0, kRecent);
  rebuild();
}

void ProbeLibrary::note(const QString& path) {
  if (path.startsWith(kBuiltin)) return;
  made_.erase(path);  // the file may be another one by now
  recent_.removeAll(path);
  recent_.prepend(path);
  recent_ = recent_.mid(0, kRecent);
  rebuild();
  Q_EMIT recentChanged();
}

void ProbeLibrary::rebuild() {
  QStringList paths;
  for (const BuiltInSky& sky : builtInSkies()) paths << kBuiltin + QString::fromStdString(sky.name);
  paths << project_;
  for (const QString& path : recent_)
    if (QFileInfo::exists(path)) paths << path;
  paths.removeDuplicates();
  probes_.clear();
  for (const QString& path : paths) {
    const Made& made = made_[path];
    QString name = QFileInfo(path).fileName();
    for (const BuiltInSky& sky : builtInSkies())
      if (path == kBuiltin + QString::fromStdString(sky.name)) name = QString::fromStdString(sky.description);
    probes_.push_back({path, name, made.picture, made.error});
  }
  Q_EMIT changed();
  makePictures();
}

// One job makes all that are missing. A newer request takes its place; what it had made by then is kept.
void ProbeLibrary::makePictures() {
  QStringList missing;
  for (const Probe& probe : probes_)
    if (!probe.picture && probe.error.isEmpty()) missing << probe.path;
  if (!wanted_ || missing.isEmpty()) return;
  struct Results {
    std::mutex mutex;
    std::map<QString, Made> made;
  };
  auto results = std::make_shared<Results>();
  const auto work = [results, missing](Job& job) {
    job.begin("making pictures of environments", std::uint64_t(missing.size()), "environments");
    for (const QString& path : missing) {
      job.checkCancelled();
      Made made;
      try {
        made.picture = std::make_shared<Image>(probePicture(mapOf(path), kPictureWidth, kPictureHeight));
      } catch (const Error& error) {
        made.error = QString::fromUtf8(error.what());
      }
      std::lock_guard lock(results->mutex);
      results->made[path] = made;
      job.advance(1);
    }
  };
  const auto finish = [self = QPointer(this), results](const JobInfo&) {
    if (!self) return;
    std::lock_guard lock(results->mutex);
    for (auto& [path, made] : results->made) self->made_[path] = made;
    if (!results->made.empty()) self->rebuild();
  };
  runner_.startQuietly(QStringLiteral("thumbnails"), tr("Pictures of environments"), work, finish);
}

}  // namespace prt::ui
