#include "ui/docks/transfer_dock.h"

#include "ui/docks/error_section.h"
#include "ui/model/session.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/state_dot.h"
#include "ui/widgets/theme.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>

#include <string_view>

namespace prt::ui {

TransferDock::TransferDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      message_(new MessageBar),
      button_(new QPushButton),
      summary_(new QLabel),
      products_(new QWidget) {
  auto* bake = new Section(tr("Transfer"));
  bake->add(message_);
  for (const char* path : {"transfer.kind", "transfer.where", "transfer.texels", "transfer.bands",
                           "transfer.rays", "transfer.bounces", "transfer.shadows"}) {
    auto* row = new PropertyRow(session.document(), QLatin1String(path));
    if (path == std::string_view("transfer.texels")) texels_ = row;
    bake->add(row);
  }
  auto* automatic = new QCheckBox(tr("Bake by itself after edits"));
  automatic->setChecked(session_.bakes().automatic());
  automatic->setToolTip(
      tr("On, every edit that needs a bake starts it at once. Off, products become stale until you bake."));
  connect(automatic, &QCheckBox::toggled, &session_.bakes(), &BakeController::setAutomatic);
  bake->add(automatic);
  button_->setObjectName(QStringLiteral("bakeButton"));
  bake->add(button_);
  add(bake);

  auto* products = new Section(tr("Products"));
  auto* grid = new QGridLayout(products_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(kGrid);
  grid->setVerticalSpacing(2);
  grid->setColumnStretch(1, 1);
  products->add(products_);
  setRole(summary_, "muted");
  summary_->setWordWrap(true);
  products->add(summary_);
  add(products);
  add(new ErrorSection(session_));

  connect(button_, &QPushButton::clicked, &session_.bakes(), &BakeController::bakeOrCancel);
  connect(&session_.bakes(), &BakeController::changed, this, &TransferDock::refresh);
  connect(&session_, &Session::statusChanged, this, &TransferDock::refresh);
  connect(&session_, &Session::message, this, [this](Severity severity, const QString& text, Place place) {
    if (place == Place::Transfer) message_->show(severity, text);
  });
  refresh();
}

void TransferDock::refresh() {
  const BakeController& bakes = session_.bakes();
  if (bakes.error().isEmpty()) message_->hide();
  texels_->setEnabled(session_.document().recipe().transfer.where == TransferWhere::Texel);
  button_->setText(bakes.baking() ? tr("Cancel") : tr("Bake"));
  button_->setIcon(bakes.baking() ? icon(QStringLiteral("process-stop")) : icon(QStringLiteral("run-build")));
  button_->setEnabled(bakes.baking() || !bakes.fresh());
  button_->setToolTip(bakes.baking()
                          ? tr("Stop here; what is done is kept and the next bake goes on from it.")
                          : tr("Bake everything that is out of date."));
  summary_->setText(session_.transferSummary());
  refreshProducts();
}

void TransferDock::refreshProducts() {
  auto* grid = static_cast<QGridLayout*>(products_->layout());
  std::vector<StageInfo> infos = session_.bakes().stageInfos();
  std::erase_if(infos, [](const StageInfo& info) {  // charts and the meso scale have docks of their own
    static const QStringList others{QStringLiteral("patch"),  QStringLiteral("rtt"),
                                    QStringLiteral("charts"), QStringLiteral("atlas"),
                                    QStringLiteral("field"),  QStringLiteral("synthesis"),
                                    QStringLiteral("layers"), QStringLiteral("idmap")};
    return !info.stored || others.contains(info.name);
  });
  for (int row = 0; row < grid->rowCount(); ++row)
    for (int column = 0; column < 3; ++column)
      if (const auto* item = grid->itemAtPosition(row, column))
        item->widget()->setVisible(row < int(infos.size()));
  for (int row = 0; row < int(infos.size()); ++row) {
    if (!grid->itemAtPosition(row, 0)) {
      grid->addWidget(new StateDot, row, 0);
      grid->addWidget(new QLabel, row, 1);
      auto* state = new QLabel;
      setRole(state, "muted");
      grid->addWidget(state, row, 2, Qt::AlignRight);
    }
    const StageInfo& info = infos[std::size_t(row)];
    static_cast<StateDot*>(grid->itemAtPosition(row, 0)->widget())->setStatus(info.status);
    auto* name = static_cast<QLabel*>(grid->itemAtPosition(row, 1)->widget());
    name->setText(info.name);
    name->setToolTip(info.makes);
    static_cast<QLabel*>(grid->itemAtPosition(row, 2)->widget())->setText(statusText(info));
  }
}

}  // namespace prt::ui
