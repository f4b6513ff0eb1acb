#include "ui/widgets/dock_title.h"

#include "ui/widgets/theme.h"

#include <QDockWidget>
#include <QHBoxLayout>
#include <QPainter>
#include <QToolButton>

namespace prt::ui {

namespace {

constexpr int kHeight = 26;

QToolButton* smallButton(const QString& iconName, const QString& tip) {
  auto* button = new QToolButton;
  button->setIcon(icon(iconName, theme().muted));
  button->setIconSize({12, 12});
  button->setToolTip(tip);
  button->setFocusPolicy(Qt::NoFocus);
  button->hide();
  return button;
}

}  // namespace

DockTitle::DockTitle(QDockWidget* dock)
    : QWidget(dock),
      dock_(dock),
      float_(smallButton(QStringLiteral("window-restore"), tr("Float, or dock again"))),
      close_(smallButton(QStringLiteral("window-close"), tr("Close; the View menu brings it back"))) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, kGrid, 0);
  row->setSpacing(0);
  row->addStretch(1);
  row->addWidget(float_);
  row->addWidget(close_);
  connect(float_, &QToolButton::clicked, dock, [dock] { dock->setFloating(!dock->isFloating()); });
  connect(close_, &QToolButton::clicked, dock, &QDockWidget::close);
}

void DockTitle::setFolded(bool folded) {
  if (folded == folded_) return;
  folded_ = folded;
  setVisible(!folded);
  updateGeometry();
}

QSize DockTitle::sizeHint() const {
  return {80, folded_ ? 0 : kHeight};
}

void DockTitle::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme().panel);
  painter.setPen(theme().window);
  painter.drawLine(0, height() - 1, width(), height() - 1);
  QFont bold = font();
  bold.setWeight(QFont::DemiBold);
  painter.setFont(bold);
  painter.setPen(theme().text);
  painter.drawText(rect().adjusted(2 * kGrid, 0, -48, -1), Qt::AlignVCenter | Qt::AlignLeft,
                   dock_->windowTitle());
}

void DockTitle::enterEvent(QEnterEvent*) {
  float_->show();
  close_->show();
}

void DockTitle::leaveEvent(QEvent*) {
  float_->hide();
  close_->hide();
}

}  // namespace prt::ui
