#include "ui/widgets/section.h"

#include "ui/widgets/theme.h"

#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

namespace prt::ui {

Section::Section(const QString& title, QWidget* parent)
    : QWidget(parent), header_(new QToolButton), body_(new QWidget), rows_(new QVBoxLayout(body_)) {
  header_->setText(title);
  header_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  header_->setArrowType(Qt::DownArrow);
  header_->setCheckable(true);
  header_->setChecked(true);
  header_->setObjectName(QStringLiteral("sectionHeader"));
  header_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  connect(header_, &QToolButton::toggled, this, &Section::setOpen);

  rows_->setContentsMargins(2 * kGrid, 0, 2 * kGrid, kGrid);
  rows_->setSpacing(2);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  all->addWidget(header_);
  all->addWidget(body_);
}

void Section::setTitle(const QString& title) {
  header_->setText(title);
}
void Section::add(QWidget* widget) {
  rows_->addWidget(widget);
}
void Section::addLayout(QLayout* layout) {
  rows_->addLayout(layout);
}
bool Section::isOpen() const {
  return header_->isChecked();
}
QString Section::title() const {
  return header_->text();
}

void Section::setOpen(bool open) {
  header_->setChecked(open);
  header_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
  body_->setVisible(open);
  Q_EMIT toggled(open);
}

DockColumn::DockColumn(QWidget* parent) : QWidget(parent), rows_(nullptr) {
  auto* content = new QWidget;
  rows_ = new QVBoxLayout(content);
  rows_->setContentsMargins(0, kGrid, 0, kGrid);
  rows_->setSpacing(kGrid);
  rows_->addStretch(1);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(content);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(scroll);
  setObjectName(QStringLiteral("dockBody"));
}

void DockColumn::add(QWidget* widget) {
  rows_->insertWidget(rows_->count() - 1, widget);
}

void DockColumn::addFilling(QWidget* widget) {
  rows_->setStretch(rows_->count() - 1, 0);
  rows_->insertWidget(rows_->count() - 1, widget, 1);
}

QWidget* fieldRow(const QString& title, QWidget* field, const QString& tip) {
  auto* row = new QWidget;
  row->setFixedHeight(kRowHeight);
  row->setToolTip(tip);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, kResetWidth + kGrid, 0);
  layout->setSpacing(kGrid);
  auto* label = new QLabel(title);
  label->setFixedWidth(kLabelWidth);
  label->setBuddy(field);
  setRole(label, "muted");
  layout->addWidget(label);
  layout->addWidget(field, 1);
  return row;
}

}  // namespace prt::ui
