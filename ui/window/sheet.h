#pragma once
// A panel over the dimmed window, for what is looked at briefly: the command palette, the keys. Not a dialog:
// nothing waits for it. Esc, a click beside it or another window's focus close it, and the keyboard goes back
// to where it was.

#include <QPointer>
#include <QWidget>

namespace prt::ui {

class Sheet : public QWidget {
  Q_OBJECT
 public:
  /// Covers `parent`, which is to be a window; hidden at first. `panel` becomes its child.
  Sheet(QWidget* parent, QWidget* panel);

  void open();
  void close();
  bool isOpen() const { return isVisible(); }

 protected:
  /// Where the panel goes in a window of this size.
  virtual QRect panelPlace(const QSize& window) const = 0;
  /// Before it is shown, and who gets the keyboard.
  virtual QWidget* aboutToOpen() = 0;

  QWidget* panel() const { return panel_; }
  void place();
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* panel_;
  QPointer<QWidget> focusBefore_;
};

}  // namespace prt::ui
