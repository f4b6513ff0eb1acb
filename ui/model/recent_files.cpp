#include "ui/model/recent_files.h"

#include <QFileInfo>
#include <QSettings>

#include <algorithm>

namespace prt::ui {

namespace {
const QString kKey = QStringLiteral("documents/recent");
}

QStringList RecentFiles::files() const {
  return QSettings().value(kKey).toStringList();
}

void RecentFiles::add(const QString& file) {
  QStringList all = files();
  all.removeAll(file);
  all.prepend(file);
  QSettings().setValue(kKey, all.mid(0, kMost));
}

void RecentFiles::remove(const QString& file) {
  QStringList all = files();
  all.removeAll(file);
  QSettings().setValue(kKey, all);
}

void RecentFiles::removeMissing() {
  QStringList all = files();
  all.erase(std::remove_if(all.begin(), all.end(), [](const QString& f) { return !exists(f); }), all.end());
  QSettings().setValue(kKey, all);
}

void RecentFiles::clear() {
  QSettings().remove(kKey);
}

bool RecentFiles::exists(const QString& file) {
  return QFileInfo(file).isFile();
}

}  // namespace prt::ui
