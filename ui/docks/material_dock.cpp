#include "ui/docks/material_dock.h"

#include "ui/model/preset_pictures.h"
#include "ui/model/session.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/lobe_plot.h"
#include "ui/widgets/parameter_slider.h"
#include "ui/widgets/preset_grid.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QComboBox>
#include <QFrame>
#include <QHBoxLayout>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QVBoxLayout>

#include <utility>

namespace prt::ui {

namespace {
constexpr int kPicturePixels = 64;  // twice what is shown: scaled displays
}

MaterialDock::MaterialDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      editor_(session.document()),
      objects_(new QComboBox),
      presets_(new PresetGrid),
      warning_(nullptr),
      warningText_(new QLabel),
      reflection_(new Section(tr("Reflection"))),
      plot_(new LobePlot) {
  add(makeHead());
  add(makePresets());
  warning_ = makeWarning();
  reflection_->add(warning_);
  add(reflection_);
  auto* lobe = new Section(tr("Lobe"));
  lobe->add(plot_);
  add(lobe);
  connect(objects_, &QComboBox::activated, &session_, &Session::selectObject);
  connect(&session_, &Session::selectionChanged, this, &MaterialDock::showObject);
  connect(&session_.document(), &Document::recipeChanged, this, &MaterialDock::refreshObjects);
  refreshObjects();
  showObject(session_.selectedObject());
}

QWidget* MaterialDock::makeHead() {
  objects_->setToolTip(tr("The object whose material is edited; the same selection as in the scene list."));
  auto* head = new QWidget;
  auto* layout = new QVBoxLayout(head);
  layout->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, 0);
  layout->addWidget(objects_);
  return head;
}

Section* MaterialDock::makePresets() {
  QStringList names, tips;
  for (const MaterialPreset& preset : materialPresets()) names << preset.name, tips << preset.about;
  presets_->setPresets(names, tips);
  connect(presets_, &PresetGrid::chosen, this, [this](int index) {
    editor_.apply(materialPresets()[std::size_t(index)], session_.selectedObject());
  });
  auto* section = new Section(tr("Presets"));
  section->add(presets_);
  return section;
}

QFrame* MaterialDock::makeWarning() {
  auto* frame = new QFrame;
  frame->setObjectName(QStringLiteral("energyWarning"));
  auto* layout = new QHBoxLayout(frame);
  layout->setContentsMargins(2 * kGrid, kGrid, kGrid, kGrid);
  layout->setSpacing(2 * kGrid);
  warningText_->setWordWrap(true);
  setRole(warningText_, "stale");
  auto* fix = new QPushButton(tr("Scale down"));
  fix->setObjectName(QStringLiteral("keepEnergy"));
  fix->setToolTip(tr("Scale albedo and specular by one factor until no channel reflects more than it gets."));
  connect(fix, &QPushButton::clicked, this, [this] { editor_.keepEnergy(session_.selectedObject()); });
  layout->addWidget(warningText_, 1);
  layout->addWidget(fix);
  frame->hide();
  return frame;
}

void MaterialDock::showObject(int object) {
  delete std::exchange(rows_, new QWidget);
  auto* layout = new QVBoxLayout(rows_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  const QString base = QStringLiteral("objects[%1].material.").arg(object);
  Document& document = session_.document();
  for (const char* name : {"model", "albedo", "specular", "exponent"})
    layout->addWidget(new PropertyRow(document, base + QLatin1String(name)));
  layout->addWidget(new ParameterSlider(document, base + QStringLiteral("exponent")));
  layout->addWidget(new PropertyRow(document, base + QStringLiteral("twoSided")));
  reflection_->add(rows_);
  objects_->setCurrentIndex(object);
  refreshMaterial();
}

void MaterialDock::refreshObjects() {
  QStringList names;
  for (const ObjectRecipe& object : session_.document().recipe().objects)
    names << QString::fromStdString(object.name);
  if (names != names_) {  // every move of a slider comes by here
    names_ = names;
    objects_->clear();
    objects_->addItems(names);
  }
  objects_->setCurrentIndex(session_.selectedObject());
  refreshMaterial();
}

void MaterialDock::refreshMaterial() {
  const Material* material = editor_.material(session_.selectedObject());
  if (!material) return;
  plot_->setMaterial(*material);
  const MaterialPreset* preset = editor_.presetOf(session_.selectedObject());
  presets_->setCurrent(preset ? int(preset - materialPresets().data()) : -1);
  const float share = reflectedShare(*material);
  warning_->setVisible(share > 1);
  warningText_->setText(tr("Reflects %1 % of what it gets.").arg(100 * double(share), 0, 'f', 0));
  // Lambert has no lobe: its rows stay, but say so.
  if (!rows_) return;
  const bool phong = material->model != MaterialModel::Lambert;
  for (QWidget* each : rows_->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly))
    if (each->objectName().contains(u".specular") || each->objectName().contains(u".exponent"))
      each->setVisible(phong);
}

// Pictures are made once somebody can see them.
void MaterialDock::showEvent(QShowEvent* event) {
  DockColumn::showEvent(event);
  if (!std::exchange(picturesWanted_, true)) makePictures();
}

void MaterialDock::makePictures() {
  std::vector<Material> materials;
  for (const MaterialPreset& preset : materialPresets()) materials.push_back(preset.material);
  auto made = std::make_shared<std::vector<Image>>();
  const auto work = [made, materials](Job& job) { *made = materialPictures(materials, kPicturePixels, job); };
  const auto finish = [grid = QPointer(presets_), made](const JobInfo&) {
    if (!grid) return;
    std::vector<QImage> pictures;
    for (const Image& image : *made) pictures.push_back(toQImage(image));
    grid->setPictures(std::move(pictures));
  };
  session_.jobs().startQuietly(QStringLiteral("material pictures"), tr("Pictures of materials"), work,
                               finish);
}

}  // namespace prt::ui
