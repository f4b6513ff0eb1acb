#pragma once
// What a studio that crashed left behind, over the picture: which document, when, which edits; to restore,
// to open as it was saved, or to discard.

#include <QFrame>

#include <memory>

class QVBoxLayout;

namespace prt::ui {

class ProjectKeeper;
class RecoveryPlace;

class RecoveryBar : public QFrame {
  Q_OBJECT
 public:
  explicit RecoveryBar(ProjectKeeper& project, QWidget* parent = nullptr);

  /// Looks for what was left, and shows itself when there is something.
  void offer();

 Q_SIGNALS:
  void resized();

 private:
  void refresh();
  QWidget* makeRow(const std::shared_ptr<RecoveryPlace>& place);

  static constexpr int kShown = 3;
  ProjectKeeper& project_;
  QVBoxLayout* rows_;
};

}  // namespace prt::ui
