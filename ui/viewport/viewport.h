#pragma once
// The 3D view: shows the relit scene and is steered with the mouse, as ui/model/navigation.h has it; Shift +
// left or right drag turns the environment, a click selects, a right click opens a menu. Manipulators take
// the left button first where the pointer is over something of theirs. Files dropped on it are opened.

#include "libprt/shade/pick.h"
#include "ui/model/navigation.h"
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

/// Who draws: OpenGL where there is a graphics card, or one of the two whatever there is.
enum class Drawing { Automatic, OpenGl, Cpu };

class Viewport : public QWidget {
  Q_OBJECT
 public:
  explicit Viewport(Session& session, QWidget* parent = nullptr);

  Canvas& canvas() { return *canvas_; }
  Drawing drawing() const { return drawing_; }
  /// OpenGL stays away where the machine has none; a message says so.
  void setDrawing(Drawing drawing);
  /// Paints it over the picture and asks it before navigating; becomes its parent.
  void addManipulator(Manipulator* manipulator);
  /// What the mouse does here, for the status bar.
  QString hint() const;
  /// All that mouse and keys do here.
  QList<Binding> bindings() const;
  /// For pictures of the window: no frame time, all passes for smooth edges.
  void setPictureMode(bool on);
  bool pictureMode() const { return pictureMode_; }
  /// The surface at a place of this widget, in logical pixels, right on scaled displays too.
  std::optional<SurfaceHit> pick(const QPointF& at) const;
  /// Of the scene or around it; -1 where there is nothing.
  int objectAt(const QPointF& at) const;
  QSize sizeHint() const override { return {960, 720}; }

 Q_SIGNALS:
  void hintChanged(const QString& hint);
  void drawingChanged();
  /// The left button went down and up at a place, without a drag between. The object there is selected
  /// already.
  void clicked(const QPointF& at, Qt::KeyboardModifiers modifiers);
  /// A menu is wanted at a place of the screen.
  void menuRequested(const QPoint& globalAt);

 protected:
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent*) override;
  bool event(QEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void focusOutEvent(QFocusEvent*) override;

 private:
  /// A button that went down and has not moved: a click when it comes up.
  struct Press {
    QPointF at;
    Qt::MouseButton button;
  };

  void chooseCanvas();
  void show(Canvas* canvas);
  void useCpu();
  CanvasContext canvasContext();
  void paintOver(QPainter& painter);
  bool pressManipulator(QMouseEvent* event);
  void hoverManipulators(std::optional<QPointF> at);
  void letGo(bool keep, const QPointF& at = {});
  void drag(const QPointF& moved);
  void endDrag();
  void click(const Press& press, const QPointF& globalAt, Qt::KeyboardModifiers modifiers);
  void turnLight(float pixels);
  void zoom(float steps, const QPointF& at);
  void interact();
  void refresh();

  Session& session_;
  Drawing drawing_ = Drawing::Automatic;
  Canvas* canvas_ = nullptr;  // a child widget
  std::vector<Manipulator*> manipulators_;
  Manipulator* held_ = nullptr;     // has the left button
  Manipulator* hovered_ = nullptr;  // would take it
  DragAction drag_ = DragAction::None;
  Qt::MouseButton dragButton_ = Qt::NoButton;
  QPointF last_, dragFrom_;
  std::optional<Press> press_;
  bool pictureMode_ = false;
  QTimer settle_;  // when the hand rests, the edges get smooth again
};

}  // namespace prt::ui
