#include "ui/widgets/message_bar.h"

#include "ui/widgets/theme.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>

namespace prt::ui {

MessageBar::MessageBar(QWidget* parent)
    : QFrame(parent), icon_(new QLabel), text_(new QLabel), fix_(new QPushButton) {
  setObjectName(QStringLiteral("messageBar"));
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* close = new QToolButton;
  close->setIcon(icon(QStringLiteral("window-close")));
  close->setIconSize({12, 12});
  close->setToolTip(tr("Dismiss"));
  connect(close, &QToolButton::clicked, this, &QWidget::hide);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2 * kGrid, kGrid, kGrid, kGrid);
  row->setSpacing(2 * kGrid);
  row->addWidget(icon_, 0, Qt::AlignTop);
  row->addWidget(text_, 1);
  row->addWidget(fix_, 0, Qt::AlignTop);
  row->addWidget(close, 0, Qt::AlignTop);
  fix_->setObjectName(QStringLiteral("messageFix"));
  fix_->setToolTip(tr("Does what the message proposes."));
  connect(fix_, &QPushButton::clicked, this, [this] {
    hide();
    if (run_) run_();
  });
  hide();
}

void MessageBar::show(Severity severity, const QString& text) {
  const bool error = severity == Severity::Error;
  icon_->setPixmap(icon(error ? QStringLiteral("data-error") : QStringLiteral("data-warning"),
                        error ? theme().failed : theme().stale)
                       .pixmap(QSize(16, 16), devicePixelRatioF()));
  text_->setText(text);
  fix_->hide();
  run_ = {};
  QWidget::show();
  adjustSize();
}

void MessageBar::offer(const QString& label, std::function<void()> fix) {
  fix_->setText(label);
  fix_->show();
  run_ = std::move(fix);
  adjustSize();
}

QString MessageBar::text() const {
  return isVisible() ? text_->text() : QString();
}

}  // namespace prt::ui
