#pragma once
// The 3D view: shows the relit scene and is steered with the mouse.
//   Alt + left or middle drag   orbit        wheel         zoom towards the pointer
//   ... with Shift              pan          F, R          frame all, reset the view
//   Shift + left or right drag  turns the environment
// Manipulators take the left button first where the pointer is over something of theirs. Files dropped on it
// are opened.

#include "ui/viewport/canvas.h"
#include "ui/widgets/binding.h"

#include <QPointF>
#include <QTimer>
#include <QWidget>

#include <optional>
#include <vector>

namespace prt::ui {

class Manipulator;
class Session;

class Viewport : public QWidget {
  Q_OBJECT
 public:
  explicit Viewport(Session& session, QWidget* parent = nullptr);

  Canvas& canvas() { return *canvas_; }
  /// Paints it over the picture and asks it before navigating; becomes its parent.
  void addManipulator(Manipulator* manipulator);
  /// What the mouse does here, for the status bar.
  QString hint() const;
  /// All that mouse and keys do here.
  QList<Binding> bindings() const;
  /// For pictures of the window: no frame time, all passes for smooth edges.
  void setPictureMode(bool on);
  bool pictureMode() const { return pictureMode_; }
  QSize sizeHint() const override { return {960, 720}; }

 Q_SIGNALS:
  void hintChanged(const QString& hint);

 protected:
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent*) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void focusOutEvent(QFocusEvent*) override;

 private:
  enum class Drag { None, Orbit, Pan, TurnLight };

  void chooseCanvas();
  void paintOver(QPainter& painter);
  void useCpu(const QString& why);
  Drag dragOf(Qt::MouseButton button, Qt::KeyboardModifiers modifiers) const;
  void endDrag();
  bool pressManipulator(QMouseEvent* event);
  void hoverManipulators(std::optional<QPointF> at);
  void letGo(bool keep, const QPointF& at = {});
  void turnLight(float pixels);
  void interact();
  void refresh();

  Session& session_;
  Canvas* canvas_ = nullptr;  // a child widget
  std::vector<Manipulator*> manipulators_;
  Manipulator* held_ = nullptr;     // has the left button
  Manipulator* hovered_ = nullptr;  // would take it
  Drag drag_ = Drag::None;
  Qt::MouseButton dragButton_ = Qt::NoButton;
  QPointF last_;
  bool pictureMode_ = false;
  QTimer settle_;  // when the hand rests, the edges get smooth again
};

}  // namespace prt::ui
