#include "ui/window/sheet.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

namespace prt::ui {

namespace {
constexpr QColor kDim(0, 0, 0, 96);
}

Sheet::Sheet(QWidget* parent, QWidget* panel) : QWidget(parent), panel_(panel) {
  panel_->setParent(this);
  panel_->setObjectName(QStringLiteral("sheet"));
  parent->installEventFilter(this);
  hide();
}

void Sheet::open() {
  focusBefore_ = QApplication::focusWidget();
  QWidget* first = aboutToOpen();
  place();
  show();
  raise();
  first->setFocus(Qt::PopupFocusReason);
}

void Sheet::close() {
  if (!isVisible()) return;
  const bool hadFocus = isAncestorOf(QApplication::focusWidget());
  hide();
  if (hadFocus && focusBefore_) focusBefore_->setFocus(Qt::PopupFocusReason);
}

void Sheet::place() {
  setGeometry(parentWidget()->rect());
  panel_->setGeometry(panelPlace(size()));
}

void Sheet::paintEvent(QPaintEvent*) {
  QPainter(this).fillRect(rect(), kDim);
}

void Sheet::mousePressEvent(QMouseEvent* event) {
  if (!panel_->geometry().contains(event->position().toPoint())) close();
}

void Sheet::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return close();
  QWidget::keyPressEvent(event);
}

bool Sheet::eventFilter(QObject* watched, QEvent* event) {
  if (watched != parentWidget() || !isVisible()) return false;
  if (event->type() == QEvent::Resize) place();
  if (event->type() == QEvent::WindowDeactivate) close();
  return false;
}

}  // namespace prt::ui
