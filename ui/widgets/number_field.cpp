#include "ui/widgets/number_field.h"

#include "ui/model/expression.h"
#include "ui/widgets/theme.h"

#include <QApplication>
#include <QKeyEvent>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPainter>
#include <QStyle>
#include <QToolTip>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {
constexpr double kPixelsPerRange = 240;  // a drag of this length crosses the whole range
constexpr double kScrubThreshold = 3;
constexpr double kFine = 0.1, kCoarse = 10;

double factorOf(Qt::KeyboardModifiers modifiers) {
  if (modifiers & Qt::ShiftModifier) return kFine;
  if (modifiers & Qt::ControlModifier) return kCoarse;
  return 1;
}
}  // namespace

NumberField::NumberField(const NumberFormat& format, QWidget* parent) : QWidget(parent), format_(format) {
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::SizeHorCursor);
  setStatusTip(hint());
  setFixedHeight(kRowHeight - 2);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QString NumberField::hint() {
  return tr(
      "Drag changes the number   \u00b7   Shift fine, Ctrl coarse   \u00b7   click to type   \u00b7   double "
      "click resets");
}

QList<Binding> NumberField::bindings() {
  return {{tr("Drag"), tr("on number or label: change it; Shift fine, Ctrl coarse")},
          {tr("Click or Enter"), tr("type: 3*24, 1.5k, 90 deg")},
          {tr("Wheel or Up or Down"), tr("step, while it has the keyboard")},
          {tr("Double click"), tr("back to the default")},
          {tr("Esc"), tr("take a drag back")},
          {tr("Right click"), tr("copy, paste, reset, what it costs")}};
}

void NumberField::setValue(double value) {
  value_ = value;
  setAccessibleName(text());
  update();
}

QString NumberField::text() const {
  return formatNumber(value_, format_.decimals);
}
bool NumberField::editing() const {
  return editor_ != nullptr;
}
QSize NumberField::sizeHint() const {
  return {96, kRowHeight - 2};
}
QSize NumberField::minimumSizeHint() const {
  return {48, kRowHeight - 2};
}

double NumberField::bounded(double value) const {
  if (format_.high > format_.low) value = std::clamp(value, format_.low, format_.high);
  return format_.decimals == 0 ? std::round(value) : value;
}

double NumberField::fraction() const {
  if (format_.high <= format_.low) return 0;
  if (format_.logarithmic) return std::log(value_ / format_.low) / std::log(format_.high / format_.low);
  return (value_ - format_.low) / (format_.high - format_.low);
}

double NumberField::scrubbed(double from, double pixels, Qt::KeyboardModifiers modifiers) const {
  const double amount = pixels * factorOf(modifiers);
  if (format_.logarithmic)
    return bounded(from * std::pow(format_.high / format_.low, amount / kPixelsPerRange));
  if (format_.high > format_.low && format_.high - format_.low <= 1e4)
    return bounded(from + amount * (format_.high - format_.low) / kPixelsPerRange);
  // No range worth the name: a hundred pixels double the value, and small ones move in hundredths.
  return bounded(from + amount * std::max(std::abs(from), 1.0) / 100);
}

void NumberField::change(double value) {
  value = bounded(value);
  if (value == value_) return;
  setValue(value);
  Q_EMIT edited(value);
}

void NumberField::stepBy(double steps, Qt::KeyboardModifiers modifiers) {
  if (format_.logarithmic) {
    return change(scrubbed(value_, steps * 4, modifiers));
  }
  double step = format_.step;
  if (step <= 0)
    step =
        format_.decimals == 0 ? 1 : (format_.high > format_.low ? (format_.high - format_.low) / 100 : 0.1);
  change(value_ +
         steps * step * (format_.decimals == 0 ? std::max(1.0, factorOf(modifiers)) : factorOf(modifiers)));
}

void NumberField::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Theme& t = theme();
  const bool hot = isEnabled() && (underMouse() || scrubbing_);
  const QRectF box = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  painter.setPen(hasFocus() ? t.accent : (hot ? t.line : t.field));
  painter.setBrush(hot ? t.fieldHover : t.field);
  painter.drawRoundedRect(box, 3, 3);

  if (format_.high > format_.low && isEnabled()) {
    QRectF bar = box.adjusted(1, 0, -1, -1);
    bar.setTop(bar.bottom() - 2);
    bar.setWidth(bar.width() * std::clamp(fraction(), 0.0, 1.0));
    painter.setPen(Qt::NoPen);
    painter.setBrush(hot ? t.accent : mixed(t.field, t.muted, 0.45));
    painter.drawRect(bar);
  }

  QRectF area = box.adjusted(6, 0, -6, -1);
  if (!format_.prefix.isEmpty()) {
    painter.setPen(t.muted);
    painter.drawText(area, Qt::AlignVCenter | Qt::AlignLeft, format_.prefix);
    area.setLeft(area.left() + fontMetrics().horizontalAdvance(format_.prefix) + 2);
  }
  if (!format_.unit.isEmpty()) {
    painter.setPen(t.muted);
    painter.drawText(area, Qt::AlignVCenter | Qt::AlignRight, format_.unit);
    area.setRight(area.right() - fontMetrics().horizontalAdvance(format_.unit) - 4);
  }
  painter.setPen(isEnabled() ? t.text : t.muted);
  painter.drawText(area, Qt::AlignVCenter | Qt::AlignRight, text());
}

void NumberField::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return QWidget::mousePressEvent(event);
  pressed_ = true;
  scrubbing_ = false;
  pressedAt_ = event->position();
  valueAtPress_ = value_;
}

void NumberField::mouseMoveEvent(QMouseEvent* event) {
  if (!pressed_) return;
  const double moved = event->position().x() - pressedAt_.x();
  if (!scrubbing_ && std::abs(moved) < kScrubThreshold) return;
  if (!scrubbing_) {
    scrubbing_ = true;
    Q_EMIT gestureBegan();
  }
  change(scrubbed(valueAtPress_, moved, event->modifiers()));
}

void NumberField::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || !pressed_) return;
  pressed_ = false;
  if (scrubbing_) {
    scrubbing_ = false;
    Q_EMIT gestureEnded();
    update();
  } else if (rect().contains(event->position().toPoint())) {  // not where the label passed a click on
    beginEditing();
  }
}

void NumberField::wheelEvent(QWheelEvent* event) {
  if (!hasFocus()) return event->ignore();  // scrolling a panel must not change values
  stepBy(event->angleDelta().y() / 120.0, event->modifiers());
  event->accept();
}

void NumberField::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Up:
    case Qt::Key_Right:
      return stepBy(1, event->modifiers());
    case Qt::Key_Down:
    case Qt::Key_Left:
      return stepBy(-1, event->modifiers());
    case Qt::Key_Return:
    case Qt::Key_Enter:
    case Qt::Key_F2:
      return beginEditing();
    case Qt::Key_Escape:
      if (scrubbing_) {
        change(valueAtPress_);
        pressed_ = scrubbing_ = false;
        Q_EMIT gestureEnded();
        return;
      }
      break;
    default:
      break;
  }
  // Typing a number begins to edit with it.
  if (!event->text().isEmpty() &&
      (event->text()[0].isDigit() || QStringLiteral("-.(").contains(event->text()[0]))) {
    beginEditing();
    editor_->setText(event->text());
    return;
  }
  QWidget::keyPressEvent(event);
}

void NumberField::resizeEvent(QResizeEvent*) {
  if (editor_) editor_->setGeometry(rect());
}

void NumberField::beginEditing() {
  if (editor_ || !isEnabled()) return;
  editor_ = new QLineEdit(text(), this);
  editor_->setGeometry(rect());
  editor_->setAlignment(Qt::AlignRight);
  editor_->selectAll();
  editor_->installEventFilter(this);
  editor_->show();
  editor_->setFocus();
  editingSince_.start();
}

bool NumberField::eventFilter(QObject* watched, QEvent* event) {
  if (watched != editor_) return false;
  if (event->type() == QEvent::FocusOut) {
    if (evaluateExpression(editor_->text(), format_.unit))
      commit();
    else
      closeEditor();
    return true;
  }
  // The first click opened the editor; a second one right after it is the double click that resets.
  const bool press =
      event->type() == QEvent::MouseButtonPress || event->type() == QEvent::MouseButtonDblClick;
  if (press && editingSince_.elapsed() < QApplication::doubleClickInterval()) {
    closeEditor();
    Q_EMIT resetRequested();
    return true;
  }
  if (event->type() != QEvent::KeyPress) return false;
  switch (static_cast<QKeyEvent*>(event)->key()) {
    case Qt::Key_Return:
    case Qt::Key_Enter:
      commit();
      return true;
    case Qt::Key_Escape:
      closeEditor();
      return true;
    default:
      return false;
  }
}

void NumberField::commit() {
  const auto value = evaluateExpression(editor_->text(), format_.unit);
  if (!value) {
    editor_->setProperty("invalid", true);
    editor_->style()->polish(editor_);
    QToolTip::showText(editor_->mapToGlobal(QPoint(0, height())),
                       tr("not a number: type something like 12, 3*8 or 1.5k"), editor_);
    return;
  }
  closeEditor();
  change(*value);
}

void NumberField::closeEditor() {
  if (!editor_) return;
  QLineEdit* closing = editor_;
  editor_ = nullptr;
  closing->removeEventFilter(this);
  const bool hadFocus = closing->hasFocus();
  closing->hide();
  closing->deleteLater();
  if (hadFocus) setFocus();
}

}  // namespace prt::ui
