#include "ui/docks/synthesis_dock.h"

#include "libprt/project/laid_patch.h"
#include "ui/docks/bake_footer.h"
#include "ui/docks/layer_section.h"
#include "ui/model/field_editor.h"
#include "ui/model/id_view.h"
#include "ui/model/session.h"
#include "ui/model/wish_editor.h"
#include "ui/widgets/exemplar_square.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>

namespace prt::ui {

SynthesisDock::SynthesisDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      look_(session.bakes()),
      shown_(new QCheckBox(tr("Patch on the surface"))),
      map_(new QLabel),
      footer_(
          new BakeFooter(session, QStringLiteral("synthesis"),
                         {QStringLiteral("field"), QStringLiteral("charts"), QStringLiteral("atlas"),
                          QStringLiteral("layers"), QStringLiteral("synthesis"), QStringLiteral("idmap")})) {
  add(makeShown());
  laying_ = makeRows(tr("Laying"),
                     {"synthesis.mapping", "synthesis.scale", "synthesis.repeat", "synthesis.vertices",
                      "synthesis.jitter", "synthesis.passes", "synthesis.seed"});
  direction_ = makeRows(tr("Direction"), {"field.symmetry", "field.angle", "field.width"});
  makeStrokes();
  makeWishes();
  texture_ = makeRows(tr("Id map"), {"idmap.size", "idmap.neighbours"});
  layers_ = new LayerSection(session_);
  for (Section* section : {laying_, direction_, parts_, layers_, texture_}) add(section);
  map_->setObjectName(QStringLiteral("idMap"));
  map_->setAlignment(Qt::AlignCenter);
  map_->setToolTip(tr("The place in the patch of every texel of the atlas: u in red, v in green."));
  texture_->add(map_);
  ids_ = new QCheckBox(tr("Ids on the surface"));
  ids_->setObjectName(QStringLiteral("showIds"));
  ids_->setToolTip(tr("The place in the patch that every place of the model shows: u in red, v in green."));
  connect(ids_, &QCheckBox::clicked, this, [this](bool on) { session_.ids().setShown(on); });
  texture_->add(ids_);
  connect(&session_.ids(), &IdView::changed, this, &SynthesisDock::refreshResult);
  auto* result = new Section(tr("Result"));
  result->add(footer_);
  add(result);
  connect(&look_, &SynthesisLook::changed, this, &SynthesisDock::refreshResult);
  connect(&session_.bakes(), &BakeController::changed, this, &SynthesisDock::refreshResult);
  connect(&session_.document(), &Document::recipeChanged, this, &SynthesisDock::refresh);
  connect(&session_.field(), &FieldEditor::changed, this, &SynthesisDock::refreshStrokes);
  connect(&session_.painting(), &Painting::brushChanged, this, &SynthesisDock::refreshStrokes);
  connect(&session_.wishes(), &WishEditor::changed, this, &SynthesisDock::refreshWishes);
  connect(&session_.painting(), &Painting::brushChanged, this, &SynthesisDock::refreshWishes);
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
  filter_ = new PropertyRow(session_.document(), QStringLiteral("method.filter"), tr("Filter"));
  section->add(filter_);
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

QPushButton* SynthesisDock::makeButton(QHBoxLayout* row, const char* name, const QString& text,
                                       const QString& tip, std::function<void()> run) {
  auto* button = new QPushButton(text);
  button->setObjectName(QLatin1String(name));
  button->setToolTip(tip);
  button->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  connect(button, &QPushButton::clicked, this, [run = std::move(run)] { run(); });
  row->setContentsMargins(0, 2, 0, 2);
  row->setSpacing(kGrid);
  row->addWidget(button, 1);
  return button;
}

// Direct manipulation below the rows: strokes are drawn on the model.
void SynthesisDock::makeStrokes() {
  FieldEditor& field = session_.field();
  Painting& painting = session_.painting();
  auto* row = new QHBoxLayout;
  draw_ = makeButton(
      row, "drawStrokes", tr("Draw strokes"),
      tr("<p>The brush (D): drag on the model. Ctrl click erases, Esc leaves.</p>") +
          parameterTip(parameterAt("field.strokes")),
      [&painting] { painting.take(painting.brush() == Brush::Strokes ? Brush::None : Brush::Strokes); });
  draw_->setCheckable(true);
  erase_ = makeButton(row, "eraseStrokes", tr("Erase"),
                      tr("The stroke that is selected; all of them while none is."), [&field] {
                        if (field.selected() >= 0)
                          field.erase(field.selected());
                        else
                          field.eraseAll();
                      });
  direction_->addLayout(row);
  field_ = new QCheckBox(tr("Field on the surface"));
  field_->setObjectName(QStringLiteral("showField"));
  field_->setToolTip(tr(
      "Lines along the orientation field, and dots where it must wind, with their index: turns of the field "
      "there, in units of its symmetry."));
  connect(field_, &QCheckBox::clicked, this, [&field](bool on) { field.setShown(on); });
  direction_->add(field_);
  strokes_ = new QLabel;
  strokes_->setObjectName(QStringLiteral("strokesState"));
  strokes_->setWordWrap(true);
  direction_->add(strokes_);
  refreshStrokes();
}

// Which part of the patch, and where: picked on its picture, painted on the model.
void SynthesisDock::makeWishes() {
  WishEditor& wishes = session_.wishes();
  Painting& painting = session_.painting();
  parts_ = new Section(tr("Parts of the patch"));
  parts_->add(new ExemplarSquare(session_));
  width_ = new NumberField({.low = WishEditor::kLeastWidth,
                            .high = WishEditor::kMostWidth,
                            .decimals = 3,
                            .logarithmic = true,
                            .unit = QString::fromStdString(parameterAt("field.width").unit)});
  width_->setObjectName(QStringLiteral("brushWidth"));
  connect(width_, &NumberField::edited, this, [&wishes](double width) { wishes.setWidth(float(width)); });
  parts_->add(
      fieldRow(tr("Brush"), width_,
               tr("Radius of the brush relative to the diagonal of the bounding box; [ and ] change it "
                  "while painting.")));
  auto* row = new QHBoxLayout;
  const QString wish = parameterTip(parameterAt("synthesis.wishes"));
  paint_ = makeButton(
      row, "paintWishes", tr("Paint part"),
      tr("<p>The brush (W): drag on the model; what is painted takes the part that is circled "
         "above. Ctrl erases, Esc leaves.</p>") +
          wish,
      [&painting] { painting.take(painting.brush() == Brush::Wishes ? Brush::None : Brush::Wishes); });
  paint_->setCheckable(true);
  clear_ = makeButton(row, "eraseWishes", tr("Erase all"), wish, [&wishes] { wishes.eraseAll(); });
  parts_->addLayout(row);
  wishes_ = new QCheckBox(tr("Wishes on the surface"));
  wishes_->setObjectName(QStringLiteral("showWishes"));
  wishes_->setToolTip(
      tr("Where parts of the patch are wished for: u of the part in red, v in green, as in the id map."));
  connect(wishes_, &QCheckBox::clicked, this, [&wishes](bool on) { wishes.setShown(on); });
  parts_->add(wishes_);
  spots_ = new QLabel;
  spots_->setObjectName(QStringLiteral("wishesState"));
  spots_->setWordWrap(true);
  parts_->add(spots_);
  refreshWishes();
}

void SynthesisDock::refreshWishes() {
  const WishEditor& wishes = session_.wishes();
  paint_->setChecked(session_.painting().brush() == Brush::Wishes);
  clear_->setEnabled(!wishes.wishes().empty());
  wishes_->setChecked(wishes.shown());
  width_->setValue(double(wishes.width()));
  const int count = int(wishes.wishes().size());
  const bool failed = !wishes.error().isEmpty();
  spots_->setText(failed ? wishes.error() : count == 1 ? tr("1 spot") : tr("%1 spots").arg(count));
  setRole(spots_, failed ? "failed" : "muted");
  spots_->setVisible(failed || count > 0);
}

void SynthesisDock::refreshStrokes() {
  const FieldEditor& field = session_.field();
  draw_->setChecked(session_.painting().brush() == Brush::Strokes);
  field_->setChecked(field.shown());
  erase_->setEnabled(!field.strokes().empty());
  erase_->setText(field.selected() >= 0 || field.strokes().size() < 2 ? tr("Erase") : tr("Erase all"));
  const int count = int(field.strokes().size()), knots = int(field.knots().size());
  QStringList words;
  if (count > 0) words << (count == 1 ? tr("1 stroke") : tr("%1 strokes").arg(count));
  if (!field.settled())
    words << tr("field on its way\u2026");
  else if (field.field())
    words << (knots == 1 ? tr("winds in 1 place") : tr("winds in %1 places").arg(knots));
  const bool failed = !field.error().isEmpty();
  strokes_->setText(failed ? field.error() : words.join(QStringLiteral(" \u00b7 ")));
  setRole(strokes_, failed ? "failed" : "muted");
  strokes_->setVisible(!strokes_->text().isEmpty());
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
  filter_->setVisible(shown);
  for (PropertyRow* row : grownRows_)
    row->setVisible(grown && (row->path() != u"field.width" || !recipe.field.strokes.empty()));
  for (PropertyRow* row : laidRows_) row->setVisible(!grown);
  direction_->setVisible(grown);
  parts_->setVisible(grown && patch);
  layers_->setVisible(grown && patch);
  texture_->setVisible(grown);
  refreshResult();
}

void SynthesisDock::refreshResult() {
  footer_->refresh(showsPatch(session_.document().recipe()), resultText());
  ids_->setChecked(session_.ids().shown());
  ids_->setEnabled(session_.ids().available());
  const Image& map = look_.map();
  map_->setVisible(map.width > 0);
  if (map.width > 0)
    map_->setPixmap(QPixmap::fromImage(toQImage(map)).scaledToWidth(192, Qt::SmoothTransformation));
}

}  // namespace prt::ui
