#include "ui/widgets/light_list.h"

#include "libprt/project/lights.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/theme.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPainter>

#include <utility>

namespace prt::ui {

namespace {

constexpr int kEyeWidth = 24, kSwatch = 14;

QString kindOf(const LightRecipe& light) {
  if (hasSun(light)) return QObject::tr("sky with sun");
  switch (light.kind) {
    case LightKind::Environment:
      return QObject::tr("environment");
    case LightKind::Circle:
      return QObject::tr("%1\u00b0").arg(double(light.angle), 0, 'f', light.angle < 1 ? 2 : 0);
    case LightKind::Directional:
      return QObject::tr("directional");
    case LightKind::Constant:
      return QObject::tr("constant");
  }
  return {};
}

}  // namespace

LightList::LightList(LightEditor& lights, QWidget* parent) : QWidget(parent), lights_(lights) {
  setObjectName(QStringLiteral("lightList"));
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(tr("The eye mutes a light, its swatch opens a colour picker; double-click renames it."));
  connect(&lights_, &LightEditor::changed, this, &LightList::follow);
}

QSize LightList::sizeHint() const {
  return {208, std::max(1, lights_.count()) * kRowHeight};
}

void LightList::follow() {
  if (picker_ && picker_->isVisible()) {
    if (picking_ < lights_.count())
      picker_->setColor(lights_.lights()[std::size_t(picking_)].radiance);
    else
      picker_->hide();
  }
  if (renaming_ >= lights_.count()) closeEditor(false);
  updateGeometry();
  update();
}

QRect LightList::row(int light) const {
  return {0, light * kRowHeight, width(), kRowHeight};
}
QRect LightList::eye(int light) const {
  return {0, light * kRowHeight, kEyeWidth, kRowHeight};
}
QRect LightList::swatch(int light) const {
  return {kEyeWidth + kGrid, light * kRowHeight + (kRowHeight - kSwatch) / 2, kSwatch, kSwatch};
}

int LightList::lightAt(const QPoint& at) const {
  const int light = at.y() / kRowHeight;
  return rect().contains(at) && light < lights_.count() ? light : -1;
}

bool LightList::colored(int light) const {
  return light >= 0 && light < lights_.count() &&
         lights_.lights()[std::size_t(light)].kind != LightKind::Environment;
}

// ---- painting ----

void LightList::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  if (lights_.count() == 0) {
    painter.setPen(theme().muted);
    painter.drawText(rect().adjusted(kGrid, 0, 0, 0), Qt::AlignVCenter,
                     tr("No light: add one, or drop an HDR."));
  }
  for (int light = 0; light < lights_.count(); ++light) paintRow(painter, light);
}

void LightList::paintRow(QPainter& painter, int light) const {
  const Theme& t = theme();
  const LightRecipe& recipe = lights_.lights()[std::size_t(light)];
  const bool selected = light == lights_.selected();
  const QRect box = row(light);
  if (selected || light == hovered_) painter.fillRect(box, selected ? t.line : t.field);
  if (selected) painter.fillRect(QRect(box.left(), box.top(), 2, box.height()), t.accent);
  const QString eyeName = recipe.on ? QStringLiteral("view-visible") : QStringLiteral("view-hidden");
  icon(eyeName, recipe.on ? t.text : t.muted).paint(&painter, eye(light).adjusted(4, 4, -4, -4));

  painter.setOpacity(recipe.on ? 1 : 0.45);
  painter.setPen(t.line.lighter(150));
  if (recipe.kind == LightKind::Environment) {  // sky over ground
    QLinearGradient sky(swatch(light).topLeft(), swatch(light).bottomLeft());
    sky.setColorAt(0, QColor(0x6f, 0x95, 0xc8));
    sky.setColorAt(0.55, QColor(0xd8, 0xe0, 0xe6));
    sky.setColorAt(0.56, QColor(0x6a, 0x5f, 0x50));
    painter.setBrush(sky);
    painter.drawRoundedRect(QRectF(swatch(light)).adjusted(0.5, 0.5, -0.5, -0.5), 2, 2);
  } else {
    painter.setBrush(toScreenScaled(recipe.radiance));
    painter.drawEllipse(QRectF(swatch(light)).adjusted(0.5, 0.5, -0.5, -0.5));
  }
  const QRect text = box.adjusted(kEyeWidth + kSwatch + 3 * kGrid, 0, -2 * kGrid, 0);
  const QString kind = kindOf(recipe);
  painter.setPen(t.muted);
  painter.drawText(text, Qt::AlignVCenter | Qt::AlignRight, kind);
  painter.setPen(t.text);
  const int room = text.width() - fontMetrics().horizontalAdvance(kind) - 2 * kGrid;
  painter.drawText(text, Qt::AlignVCenter,
                   fontMetrics().elidedText(QString::fromStdString(recipe.name), Qt::ElideRight, room));
  painter.setOpacity(1);
}

// ---- mouse and keys ----

void LightList::mousePressEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  const int light = lightAt(at);
  closeEditor(true);
  if (event->button() != Qt::LeftButton) return lights_.select(light);
  if (light >= 0 && eye(light).contains(at))
    return lights_.setOn(light, !lights_.lights()[std::size_t(light)].on);
  lights_.select(light);
  if (light >= 0 && swatch(light).adjusted(-2, -2, 2, 2).contains(at)) pickColor(light);
}

void LightList::mouseDoubleClickEvent(QMouseEvent* event) {
  const QPoint at = event->position().toPoint();
  const int light = lightAt(at);
  if (light < 0 || at.x() < swatch(light).right() + 2) return mousePressEvent(event);
  rename(light);
}

void LightList::mouseMoveEvent(QMouseEvent* event) {
  const int light = lightAt(event->position().toPoint());
  if (std::exchange(hovered_, light) != light) update();
}

void LightList::leaveEvent(QEvent*) {
  hovered_ = -1;
  update();
}

void LightList::keyPressEvent(QKeyEvent* event) {
  const int light = lights_.selected();
  switch (event->key()) {
    case Qt::Key_Up:
      return lights_.select(std::max(0, light - 1));
    case Qt::Key_Down:
      return lights_.select(std::min(lights_.count() - 1, light + 1));
    default:
      break;
  }
  if (light < 0) return QWidget::keyPressEvent(event);
  switch (event->key()) {
    case Qt::Key_Space:
      return lights_.setOn(light, !lights_.lights()[std::size_t(light)].on);
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      return lights_.remove(light);
    case Qt::Key_F2:
      return rename(light);
    default:
      return QWidget::keyPressEvent(event);
  }
}

void LightList::pickColor(int light) {
  if (!colored(light)) return;
  if (!picker_) {
    picker_ = new ColorPicker(ColorField::Kind::Light, this);
    connect(picker_, &ColorPicker::picked, this,
            [this](const Rgb& color) { lights_.setColor(picking_, color); });
    connect(picker_, &ColorPicker::gestureBegan, this, [this] {
      if (colored(picking_))
        lights_.beginDrag(
            tr("Colour of %1").arg(QString::fromStdString(lights_.lights()[std::size_t(picking_)].name)));
    });
    connect(picker_, &ColorPicker::gestureEnded, this, [this] { lights_.endDrag(); });
  }
  picking_ = light;
  picker_->setColor(lights_.lights()[std::size_t(light)].radiance);
  picker_->adjustSize();
  picker_->move(mapToGlobal(swatch(light).bottomLeft() + QPoint(0, 2)));
  picker_->show();
}

void LightList::rename(int light) {
  closeEditor(true);
  if (light < 0 || light >= lights_.count()) return;
  renaming_ = light;
  editor_ = new QLineEdit(QString::fromStdString(lights_.lights()[std::size_t(light)].name), this);
  editor_->setGeometry(row(light).adjusted(kEyeWidth + kSwatch + 2 * kGrid, 1, -2, -1));
  editor_->installEventFilter(this);
  editor_->selectAll();
  editor_->show();
  editor_->setFocus();
}

bool LightList::eventFilter(QObject* watched, QEvent* event) {
  if (watched != editor_) return false;
  if (event->type() == QEvent::FocusOut) return closeEditor(true), true;
  if (event->type() != QEvent::KeyPress) return false;
  const int key = static_cast<QKeyEvent*>(event)->key();
  if (key != Qt::Key_Return && key != Qt::Key_Enter && key != Qt::Key_Escape) return false;
  closeEditor(key != Qt::Key_Escape);
  return true;
}

void LightList::closeEditor(bool keep) {
  if (!editor_) return;
  QLineEdit* closing = std::exchange(editor_, nullptr);
  closing->removeEventFilter(this);
  const bool hadFocus = closing->hasFocus();
  closing->hide();
  closing->deleteLater();
  if (keep) lights_.rename(std::exchange(renaming_, -1), closing->text());
  renaming_ = -1;
  if (hadFocus) setFocus();
}

}  // namespace prt::ui
