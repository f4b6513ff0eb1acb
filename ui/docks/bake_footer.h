#pragma once
// What stands below the settings of a dock whose products are baked: how far the bake is, what is known of
// its result, and the button that bakes or stops.

#include "ui/model/job_runner.h"

#include <QStringList>
#include <QWidget>

class QLabel;
class QProgressBar;
class QPushButton;

namespace prt::ui {

class Session;

class BakeFooter : public QWidget {
  Q_OBJECT
 public:
  /// `stages` are what the dock shows; objects are called NAMEProgress, NAMEState and NAMEBake.
  BakeFooter(Session& session, const QString& name, const QStringList& stages, QWidget* parent = nullptr);

  /// `offered`: there is something to bake. `text` is shown while nothing of it bakes.
  void refresh(bool offered, const QString& text);

 private:
  /// The bake that runs and makes what the dock shows; null when none does.
  const JobInfo* ownJob() const;

  Session& session_;
  QStringList stages_;
  QProgressBar* bar_;
  QLabel* state_;
  QPushButton* button_;
};

}  // namespace prt::ui
