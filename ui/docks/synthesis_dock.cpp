#include "ui/docks/synthesis_dock.h"

#include "libprt/project/laid_patch.h"
#include "ui/docks/bake_footer.h"
#include "ui/model/session.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QCheckBox>
#include <QLabel>
#include <QLocale>

namespace prt::ui {

SynthesisDock::SynthesisDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      look_(session.bakes()),
      shown_(new QCheckBox(tr("Patch on the surface"))),
      map_(new QLabel),
      footer_(new BakeFooter(session, QStringLiteral("synthesis"),
                             {QStringLiteral("field"), QStringLiteral("charts"), QStringLiteral("atlas"),
                              QStringLiteral("synthesis"), QStringLiteral("idmap")})) {
  add(makeShown());
  laying_ = makeRows(tr("Laying"),
                     {"synthesis.mapping", "synthesis.scale", "synthesis.repeat", "synthesis.vertices",
                      "synthesis.jitter", "synthesis.passes", "synthesis.seed"});
  direction_ = makeRows(tr("Direction"), {"field.symmetry", "field.angle", "field.width"});
  texture_ = makeRows(tr("Id map"), {"idmap.size", "idmap.neighbours"});
  for (Section* section : {laying_, direction_, texture_}) add(section);
  map_->setObjectName(QStringLiteral("idMap"));
  map_->setAlignment(Qt::AlignCenter);
  map_->setToolTip(tr("The place in the patch of every texel of the atlas: u in red, v in green."));
  texture_->add(map_);
  auto* result = new Section(tr("Result"));
  result->add(footer_);
  add(result);
  connect(&look_, &SynthesisLook::changed, this, &SynthesisDock::refreshResult);
  connect(&session_.bakes(), &BakeController::changed, this, &SynthesisDock::refreshResult);
  connect(&session_.document(), &Document::recipeChanged, this, &SynthesisDock::refresh);
  connect(&session_.document(), &Document::opened, &look_, &SynthesisLook::forget);
  connect(&session_.jobs(), &JobRunner::changed, this, [this](quint64 id) {
    if (id == session_.bakes().job()) refreshResult();
  });
  refresh();
}

Section* SynthesisDock::makeShown() {
  auto* section = new Section(tr("Synthesis"));
  shown_->setObjectName(QStringLiteral("patchOnSurface"));
  shown_->setToolTip(
      tr("Shows both scales together: light transferred to the surface meets the patch (method.name). The "
         "patch is grown over the surface first, which takes a minute."));
  connect(shown_, &QCheckBox::clicked, this, [this](bool on) {
    session_.document().set(QStringLiteral("method.name"),
                            on ? QStringLiteral("biscale") : QStringLiteral("auto"));
  });
  section->add(shown_);
  views_ = new PropertyRow(session_.document(), QStringLiteral("method.viewDependent"), tr("Views"));
  section->add(views_);
  return section;
}

Section* SynthesisDock::makeRows(const QString& title, const std::vector<const char*>& paths) {
  auto* section = new Section(title);
  for (const char* path : paths) {
    const QString name = QLatin1String(path);
    auto* row = new PropertyRow(session_.document(), name);
    section->add(row);
    if (name == u"synthesis.repeat")
      laidRows_.push_back(row);
    else if (name != u"synthesis.mapping")
      grownRows_.push_back(row);
  }
  return section;
}

QString SynthesisDock::resultText() const {
  const Recipe& recipe = session_.document().recipe();
  if (recipe.patch.model == PatchModel::None) return tr("Choose a patch first: it is what is laid here.");
  if (!showsPatch(recipe)) return tr("The surface is shown without the patch.");
  if (recipe.synthesis.mapping == PatchMapping::Uv) return tr("Laid by the mesh's texture coordinates.");
  const auto& made = look_.synthesis();
  if (!made) return tr("Not grown yet.");
  const SynthesisQuality& q = made->quality;
  return tr("%1 vertices\nDistance to the patch %2 (1 = unrelated)\n%3 % of neighbours go on\nLongest repeat "
            "%4 patches")
      .arg(QLocale().toString(qulonglong(made->meso->vertexCount())))
      .arg(q.distance, 0, 'f', 3)
      .arg(100 * q.coherence, 0, 'f', 1)
      .arg(q.longestRepeat, 0, 'f', 1);
}

// Only the rows that the way of laying reads.
void SynthesisDock::refresh() {
  const Recipe& recipe = session_.document().recipe();
  const bool patch = recipe.patch.model != PatchModel::None, shown = showsPatch(recipe),
             grown = recipe.synthesis.mapping == PatchMapping::Synthesis;
  shown_->setEnabled(patch);
  shown_->setChecked(shown);
  views_->setVisible(shown);
  for (PropertyRow* row : grownRows_)
    row->setVisible(grown && (row->path() != u"field.width" || !recipe.field.strokes.empty()));
  for (PropertyRow* row : laidRows_) row->setVisible(!grown);
  direction_->setVisible(grown);
  texture_->setVisible(grown);
  refreshResult();
}

void SynthesisDock::refreshResult() {
  footer_->refresh(showsPatch(session_.document().recipe()), resultText());
  const Image& map = look_.map();
  map_->setVisible(map.width > 0);
  if (map.width > 0)
    map_->setPixmap(QPixmap::fromImage(toQImage(map)).scaledToWidth(192, Qt::SmoothTransformation));
}

}  // namespace prt::ui
