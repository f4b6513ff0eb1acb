#pragma once
// The environments that are a click away: the built-in ones, those of the project, and the files that were
// loaded lately; each with a small picture that is made behind the interface and kept.

#include "libprt/core/image.h"
#include "ui/model/job_runner.h"

#include <QObject>
#include <QStringList>

#include <map>
#include <memory>
#include <vector>

namespace prt::ui {

struct Probe {
  QString path;                          ///< "builtin:NAME" or an absolute file
  QString name;                          ///< for people
  std::shared_ptr<const Image> picture;  ///< encoded for the screen; null until it is made
  QString error;                         ///< why there will be none
};

class ProbeLibrary : public QObject {
  Q_OBJECT
 public:
  static constexpr int kPictureWidth = 96, kPictureHeight = 48;
  static constexpr int kRecent = 8;

  explicit ProbeLibrary(JobRunner& runner, QObject* parent = nullptr);

  /// Built-in ones first, then the project's, then recent ones.
  const std::vector<Probe>& probes() const { return probes_; }
  /// Begins making the pictures that are missing. Until it is called nothing is read.
  void wantPictures();

  /// Absolute paths of the environments in the project; built-in ones are here anyway.
  void setProject(const QStringList& paths);
  /// Files that were loaded lately, newest first.
  const QStringList& recent() const { return recent_; }
  void setRecent(const QStringList& paths);
  /// This file was just loaded.
  void note(const QString& path);

 Q_SIGNALS:
  /// Probes or pictures changed.
  void changed();
  void recentChanged();

 private:
  struct Made {
    std::shared_ptr<const Image> picture;
    QString error;
  };
  void rebuild();
  void makePictures();

  JobRunner& runner_;
  bool wanted_ = false;
  QStringList project_, recent_;
  std::map<QString, Made> made_;  // by path
  std::vector<Probe> probes_;
};

}  // namespace prt::ui
