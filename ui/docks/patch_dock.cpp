#include "ui/docks/patch_dock.h"

#include "ui/model/patch_presets.h"
#include "ui/model/session.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/patch_canvas.h"
#include "ui/widgets/preset_grid.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QLabel>
#include <QPointer>

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
      preview_(session.document(), session.jobs()),
      presets_(new PresetGrid),
      message_(new MessageBar),
      facts_(new QLabel),
      warning_(new QLabel) {
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
  add(makeRows(tr("Shape"), {{"model", kAll},
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
  add(reflection_);
  connect(&session_.document(), &Document::recipeChanged, this, &PatchDock::refresh);
  connect(&preview_, &PatchPreview::changed, this, &PatchDock::refreshPreview);
  refresh();
  refreshPreview();
}

Section* PatchDock::makePresets() {
  QStringList names, tips;
  for (const PatchPreset& preset : patchPresets()) names << preset.name, tips << preset.about;
  presets_->setObjectName(QStringLiteral("patchPresets"));
  presets_->setPresets(names, tips);
  connect(presets_, &PresetGrid::chosen, this,
          [this](int index) { applyPatchPreset(session_.document(), patchPresets()[std::size_t(index)]); });
  auto* section = new Section(tr("Built in"));
  section->add(presets_);
  return section;
}

Section* PatchDock::makeRows(const QString& title,
                             const std::vector<std::pair<const char*, unsigned>>& paths) {
  auto* section = new Section(title);
  for (const auto& [path, models] : paths) {
    auto* row = new PropertyRow(session_.document(), QStringLiteral("patch.") + QLatin1String(path));
    section->add(row);
    rows_.push_back({row, models});
  }
  return section;
}

// Only the rows that the kind of patch reads.
void PatchDock::refresh() {
  const PatchOptions& patch = session_.document().recipe().patch;
  const bool glossy = patch.specular != Rgb(0);
  for (const Row& each : rows_) {
    const QString& path = each.row->path();
    const bool lobe = path == QLatin1String("patch.exponent") || path == QLatin1String("patch.gloss");
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
