#include "ui/docks/rtt_dock.h"

#include "ui/docks/bake_footer.h"
#include "ui/model/session.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/rtt_square.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/view_grid.h"

#include <QLabel>

#include <cmath>

namespace prt::ui {

RttDock::RttDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      look_(session.bakes(), session.relighter(), session.jobs()),
      square_(new Section(tr("Under this light"))),
      views_(new Section(tr("Views"))),
      viewText_(new QLabel),
      footer_(
          new BakeFooter(session, QStringLiteral("rtt"), {QStringLiteral("patch"), QStringLiteral("rtt")})) {
  square_->add(new RttSquare(look_, session_.view()));
  setRole(viewText_, "muted");
  square_->add(viewText_);
  add(square_);
  views_->add(new ViewGrid(look_, session_.view()));
  add(views_);
  add(makeBake());
  connect(&look_, &RttLook::changed, this, &RttDock::refresh);
  connect(&session_.bakes(), &BakeController::changed, this, &RttDock::refresh);
  connect(&session_.document(), &Document::recipeChanged, this, &RttDock::refresh);
  connect(&session_.document(), &Document::opened, &look_, &RttLook::forget);
  connect(&session_.jobs(), &JobRunner::changed, this, [this](quint64 id) {
    if (id == session_.bakes().job()) refresh();
  });
  refresh();
}

Section* RttDock::makeBake() {
  auto* section = new Section(tr("Radiance transfer texture"));
  for (const char* path : {"rtt.texels", "rtt.views", "rtt.bands", "rtt.rays", "rtt.bounces",
                           "rtt.supersamples", "rtt.lobeRays", "rtt.storage"}) {
    const bool longName = QLatin1String(path) == QLatin1String("rtt.supersamples");
    section->add(
        new PropertyRow(session_.document(), QLatin1String(path), longName ? tr("Samples") : QString()));
  }
  section->add(footer_);
  return section;
}

QString RttDock::stateText() const {
  if (session_.document().recipe().patch.model == PatchModel::None)
    return tr("Choose a patch first: it is what is baked here.");
  const auto& rtt = look_.rtt();
  if (!rtt) return tr("Not baked yet.");
  const double megabytes = double(rtt->values.size() * sizeof(float)) / 1e6;
  QString text = tr("%1 \u00d7 %1 texels, %2 \u00d7 %2 views\n%3 functions%4, %5 MB, bounces: %6")
                     .arg(rtt->texels)
                     .arg(rtt->views)
                     .arg(rtt->functions())
                     .arg(rtt->channels == 3 ? tr(" in colour") : QString())
                     .arg(megabytes, 0, 'f', 1)
                     .arg(rtt->bounces);
  if (look_.storageError() > 0) text += tr("; rounding %1 %").arg(100 * look_.storageError(), 0, 'g', 2);
  return text + viewErrorText(*rtt);
}

QString RttDock::viewErrorText(const Rtt& rtt) const {
  const auto& error = look_.viewError();
  if (!error) return {};
  QString text = tr("\nOff by %1 % between its views, %2 % beyond the outermost")
                     .arg(100 * error->between, 0, 'f', 1)
                     .arg(100 * error->beyond, 0, 'f', 1);
  if (rtt.views < 16 && error->between > kMuchViewError) text += tr("; more views lower it");
  return text;
}

void RttDock::refresh() {
  const bool patch = session_.document().recipe().patch.model != PatchModel::None;
  square_->setVisible(patch);
  views_->setVisible(patch);
  footer_->refresh(patch, stateText());
  const Vec3& d = look_.view();
  viewText_->setText(tr("From %1\u00b0 off the zenith, towards %2\u00b0")
                         .arg(std::acos(double(d.z)) * 180 / M_PI, 0, 'f', 0)
                         .arg(std::atan2(double(d.y), double(d.x)) * 180 / M_PI, 0, 'f', 0));
}

}  // namespace prt::ui
