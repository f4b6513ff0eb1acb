#include "ui/docks/patch_dock.h"

#include "ui/model/layer_editor.h"
#include "ui/model/patch_presets.h"
#include "ui/model/session.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/patch_canvas.h"
#include "ui/widgets/preset_grid.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QComboBox>
#include <QLabel>
#include <QPointer>
#include <QVBoxLayout>

#include <utility>

namespace prt::ui {

namespace {

constexpr int kPicturePixels = 96;  // more than twice what is shown: scaled displays

constexpr unsigned bit(PatchModel model) {
  return 1u << unsigned(model);
}
constexpr unsigned kFlat = bit(PatchModel::Flat), kHeights = bit(PatchModel::HeightField),
                   kWeave = bit(PatchModel::Weave), kMesh = bit(PatchModel::Mesh),
                   kBtf = bit(PatchModel::Btf), kSurfaces = kFlat | kHeights | kWeave | kMesh,
                   kAll = kSurfaces | kBtf | bit(PatchModel::None);

}  // namespace

PatchDock::PatchDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      layers_(session.patchLayers()),
      preview_(session.document(), session.jobs()),
      which_(new QComboBox),
      presets_(new PresetGrid),
      message_(new MessageBar),
      facts_(new QLabel),
      warning_(new QLabel) {
  add(makeHead());
  auto* shape = new Section(tr("Patch"));
  shape->add(new PatchCanvas(preview_));
  setRole(facts_, "muted");
  setRole(warning_, "stale");
  warning_->setWordWrap(true);
  shape->add(facts_);
  shape->add(warning_);
  shape->add(message_);
  message_->hide();
  add(shape);
  add(makePresets());
  makeSections();
  connect(&layers_, &LayerEditor::changed, this, &PatchDock::refreshLayers);
  connect(&session_.document(), &Document::recipeChanged, this, &PatchDock::refresh);
  connect(&preview_, &PatchPreview::changed, this, &PatchDock::refreshPreview);
  refresh();
  refreshPreview();
}

QWidget* PatchDock::makeHead() {
  which_->setObjectName(QStringLiteral("patchLayer"));
  which_->setToolTip(
      tr("The patch that is edited: the one below, or a layer over it; the same selection as among "
         "the layers of the Synthesis dock."));
  connect(which_, &QComboBox::activated, &layers_,
          [this](int index) { layers_.select(index + LayerEditor::kPatch); });
  head_ = new QWidget;
  auto* layout = new QVBoxLayout(head_);
  layout->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, 0);
  layout->addWidget(which_);
  return head_;
}

// Rows know their parameter by its path: those of another patch are others.
void PatchDock::makeSections() {
  delete std::exchange(sections_, new QWidget);
  rows_.clear();
  auto* layout = new QVBoxLayout(sections_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(makeRows(tr("Shape"), {{"model", kAll},
                                           {"heightmap", kHeights},
                                           {"mesh", kMesh},
                                           {"btf", kBtf},
                                           {"seamless", kBtf},
                                           {"depth", kHeights | kWeave},
                                           {"count", kHeights},
                                           {"seed", kHeights},
                                           {"grid", kHeights},
                                           {"yarns", kWeave},
                                           {"radius", kWeave},
                                           {"amplitude", kWeave},
                                           {"period", kMesh}}));
  reflection_ = makeRows(tr("Reflection"), {{"texture", kSurfaces},
                                            {"albedo", kSurfaces},
                                            {"warp", kWeave},
                                            {"specular", kSurfaces},
                                            {"exponent", kSurfaces},
                                            {"gloss", kSurfaces}});
  layout->addWidget(reflection_);
  add(sections_);
}

// Only where there is a choice.
void PatchDock::refreshLayers() {
  const auto& layers = session_.document().recipe().layers;
  QStringList names{tr("patch")};
  for (const LayerRecipe& layer : layers) names << QString::fromStdString(layer.name);
  QStringList now;
  for (int i = 0; i < which_->count(); ++i) now << which_->itemText(i);
  if (now != names) {
    which_->clear();
    which_->addItems(names);
  }
  which_->setCurrentIndex(layers_.selected() - LayerEditor::kPatch);
  head_->setVisible(!layers.empty());
  if (layers_.selected() == preview_.layer()) return;
  preview_.setLayer(layers_.selected());
  makeSections();
  refresh();
}

Section* PatchDock::makePresets() {
  QStringList names, tips;
  for (const PatchPreset& preset : patchPresets()) names << preset.name, tips << preset.about;
  presets_->setObjectName(QStringLiteral("patchPresets"));
  presets_->setPresets(names, tips);
  connect(presets_, &PresetGrid::chosen, this, [this](int index) {
    applyPatchPreset(layers_, session_.document(), patchPresets()[std::size_t(index)]);
  });
  auto* section = new Section(tr("Built in"));
  section->add(presets_);
  return section;
}

Section* PatchDock::makeRows(const QString& title,
                             const std::vector<std::pair<const char*, unsigned>>& paths) {
  auto* section = new Section(title);
  for (const auto& [path, models] : paths) {
    auto* row = new PropertyRow(session_.document(), layers_.patchPath() + u'.' + QLatin1String(path));
    section->add(row);
    rows_.push_back({row, models});
  }
  return section;
}

// Only the rows that the kind of patch reads.
void PatchDock::refresh() {
  const PatchOptions& patch = patchOf(session_.document().recipe(), layers_.selected());
  const bool glossy = patch.specular != Rgb(0);
  for (const Row& each : rows_) {
    const QString& path = each.row->path();
    const bool lobe =
        path.endsWith(QLatin1String("patch.exponent")) || path.endsWith(QLatin1String("patch.gloss"));
    each.row->setVisible((each.models & bit(patch.model)) && (glossy || !lobe));
  }
  reflection_->setVisible(preview_.hasShape());
  presets_->setCurrent(patchPresetOf(patch));
}

void PatchDock::refreshPreview() {
  facts_->setText(preview_.facts());
  facts_->setVisible(!preview_.facts().isEmpty());
  warning_->setText(preview_.warning());
  warning_->setVisible(!preview_.warning().isEmpty());
  if (preview_.error().isEmpty())
    message_->hide();
  else
    message_->show(Severity::Error, preview_.error());
}

// Pictures are made once somebody can see them.
void PatchDock::showEvent(QShowEvent* event) {
  DockColumn::showEvent(event);
  if (!std::exchange(picturesWanted_, true)) makePictures();
}

void PatchDock::makePictures() {
  auto made = std::make_shared<std::vector<Image>>();
  session_.jobs().startQuietly(
      QStringLiteral("patch pictures"), tr("Pictures of patches"),
      [made](Job& job) { *made = patchPictures(kPicturePixels, job); },
      [grid = QPointer(presets_), made](const JobInfo&) {
        if (!grid) return;
        std::vector<QImage> pictures;
        for (const Image& image : *made) pictures.push_back(toQImage(image, {}));
        grid->setPictures(std::move(pictures));
      });
}

}  // namespace prt::ui
