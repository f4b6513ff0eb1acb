#pragma once
// Something in the viewport that is painted over the picture and worked with the mouse: handles of lights,
// of objects, of whatever comes. The viewport asks its manipulators first, in order; what none of them
// takes navigates.

#include "ui/viewport/view_geometry.h"
#include "ui/widgets/binding.h"

#include <QCursor>
#include <QObject>
#include <QString>

class QPainter;

namespace prt::ui {

class Manipulator : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  bool enabled() const { return enabled_; }
  /// One that is not enabled is neither painted nor asked.
  void setEnabled(bool enabled) {
    if (enabled == enabled_) return;
    enabled_ = enabled;
    Q_EMIT changed();
  }

  /// Draws over the picture, in logical pixels.
  virtual void paint(QPainter& painter, const ViewGeometry& view) = 0;
  /// The pointer is here and no button is down. True when a press here would be taken; marks what it would
  /// take. Called with nothing when the pointer has left or another one took it.
  virtual bool hover(std::optional<QPointF> at, const ViewGeometry& view) = 0;
  /// Left button without Alt. True: moves and the release go to this one until it is over.
  virtual bool press(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) = 0;
  virtual void move(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) = 0;
  virtual void release(const QPointF& at, const ViewGeometry& view) = 0;
  /// Esc, or the focus was lost: as if the press had not been.
  virtual void cancel() = 0;
  /// Double click of the left button; true when it meant something here.
  virtual bool doubleClick(const QPointF&, const ViewGeometry&) { return false; }

  /// A key (Qt::Key) while the viewport has the focus; true when it meant something here.
  virtual bool keyPress(int) { return false; }

  /// For what is hovered or dragged.
  virtual QCursor cursor() const = 0;
  /// What the mouse does there, for the status bar; empty when nothing is hovered.
  virtual QString hint() const = 0;
  /// All that mouse and keys do with it, for the overlay of keys.
  virtual QList<Binding> bindings() const { return {}; }

 Q_SIGNALS:
  /// Would be painted differently.
  void changed();

 private:
  bool enabled_ = true;
};

}  // namespace prt::ui
