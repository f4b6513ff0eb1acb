#pragma once
// The title bar of a dock: its name, and on hover what floats and closes it. In a tabbed group, where the
// tab already says the name, it takes no room.

#include <QWidget>

class QDockWidget;
class QToolButton;

namespace prt::ui {

class DockTitle : public QWidget {
  Q_OBJECT
 public:
  explicit DockTitle(QDockWidget* dock);
  /// Shown, or folded to nothing.
  void setFolded(bool folded);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return sizeHint(); }

 protected:
  void paintEvent(QPaintEvent*) override;
  void enterEvent(QEnterEvent*) override;
  void leaveEvent(QEvent*) override;

 private:
  QDockWidget* dock_;
  QToolButton* float_;
  QToolButton* close_;
  bool folded_ = false;
};

}  // namespace prt::ui
