#pragma once
// What runs in the background: bar, rate, time left, pause, cancel; what failed, why, and
// another try.

#include "ui/model/job_runner.h"

#include <QWidget>

#include <map>

class QLabel;
class QProgressBar;
class QToolButton;
class QVBoxLayout;

namespace prt::ui {

class JobRow : public QWidget {
  Q_OBJECT
 public:
  JobRow(JobRunner& runner, quint64 id);
  void refresh();

 private:
  JobRunner& runner_;
  quint64 id_;
  QLabel* title_;
  QLabel* ended_;  // how, beside the title
  QLabel* detail_;
  QProgressBar* bar_;
  QToolButton* pause_;
  QToolButton* cancel_;
  QToolButton* retry_;
};

class JobsDock : public QWidget {
  Q_OBJECT
 public:
  explicit JobsDock(JobRunner& runner, QWidget* parent = nullptr);

 private:
  void refresh(quint64 id);
  void tidy();

  static constexpr int kShown = 8;  // running ones, and the last that ended
  JobRunner& runner_;
  QVBoxLayout* rows_;
  QLabel* empty_;
  std::map<quint64, JobRow*> shown_;
};

/// "1.2 M rays/s · 12 s left", from what is known.
QString progressText(const Progress& progress);

}  // namespace prt::ui
