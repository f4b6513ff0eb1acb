#include "ui/docks/object_sections.h"

#include "ui/model/scene_editor.h"
#include "ui/model/scene_edits.h"
#include "ui/model/session.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>

namespace prt::ui {

namespace {

const ObjectRecipe* selected(Session& session) {
  const auto& objects = session.document().recipe().objects;
  const auto index = std::size_t(session.selectedObject());
  return index < objects.size() ? &objects[index] : nullptr;
}

}  // namespace

ObjectSections::ObjectSections(Session& session, QWidget* parent) : QWidget(parent), session_(session) {
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  connect(&session_, &Session::selectionChanged, this, &ObjectSections::rebuild);
  connect(&session_.document(), &Document::recipeChanged, this, &ObjectSections::refresh);
  connect(&session_, &Session::meshesChanged, this, &ObjectSections::refresh);
  rebuild();
}

void ObjectSections::rebuild() {
  delete rows_;
  rows_ = new QWidget;
  const ObjectRecipe* object = selected(session_);
  builtin_ = object && isBuiltin(object->mesh.path);
  auto* column = new QVBoxLayout(rows_);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kGrid);
  const QString base = QStringLiteral("objects[%1].").arg(session_.selectedObject());
  column->addWidget(makeTransform(base + QStringLiteral("transform.")));
  column->addWidget(makeMesh(base + QStringLiteral("mesh.")));
  column->addWidget(makePatch(base));
  column->addWidget(makeSurroundings(base));
  layout()->addWidget(rows_);
  refresh();
}

QWidget* ObjectSections::makeTransform(const QString& base) {
  auto* section = new Section(tr("Transform"));
  Document& document = session_.document();
  section->add(new PropertyRow(document, base + QStringLiteral("translate"), tr("Position")));
  section->add(new PropertyRow(document, base + QStringLiteral("rotate"), tr("Rotation")));
  section->add(new PropertyRow(document, base + QStringLiteral("scale"), tr("Scale")));
  size_ = new NumberField({.decimals = 3, .unit = QStringLiteral("\u00d7")});
  size_->setObjectName(QStringLiteral("objectSize"));
  section->add(fieldRow(tr("Size"), size_, tr("Scales along all axes together; proportions stay.")));
  connect(size_, &NumberField::edited, this,
          [this](double size) { session_.sceneEditor().resize(session_.selectedObject(), size); });
  connect(size_, &NumberField::gestureBegan, this, [this] { session_.document().beginGesture(tr("Size")); });
  connect(size_, &NumberField::gestureEnded, this, [this] { session_.document().endGesture(); });
  connect(size_, &NumberField::resetRequested, this,
          [this] { session_.sceneEditor().resize(session_.selectedObject(), 1); });

  rest_ = new QPushButton(tr("Rest on ground"));
  rest_->setObjectName(QStringLiteral("restOnGround"));
  rest_->setToolTip(
      tr("Moves the object up or down until its lowest point lies on the ground plane, or at height 0."));
  centre_ = new QPushButton(tr("Centre"));
  centre_->setObjectName(QStringLiteral("centreObject"));
  centre_->setToolTip(tr("Moves the object sideways until the middle of its bounds stands over the origin."));
  connect(rest_, &QPushButton::clicked, this,
          [this] { session_.sceneEditor().restOnGround(session_.selectedObject()); });
  connect(centre_, &QPushButton::clicked, this,
          [this] { session_.sceneEditor().centre(session_.selectedObject()); });
  auto* buttons = new QHBoxLayout;
  buttons->setContentsMargins(0, kGrid, 0, 0);
  buttons->setSpacing(kGrid);
  buttons->addWidget(rest_, 3);
  buttons->addWidget(centre_, 2);
  section->addLayout(buttons);
  section->setOpen(transformOpen_);
  connect(section, &Section::toggled, this, [this](bool open) { transformOpen_ = open; });
  return section;
}

QWidget* ObjectSections::makeMesh(const QString& base) {
  auto* section = new Section(tr("Mesh"));
  const std::initializer_list<const char*> ofBuiltin{"path", "detail", "seed"};
  const std::initializer_list<const char*> ofFile{"path",        "weld",  "orientation", "splitNonManifold",
                                                  "keepNormals", "crease"};
  for (const char* name : builtin_ ? ofBuiltin : ofFile) {
    const bool cut = QLatin1String(name) == QLatin1String("splitNonManifold");
    section->add(new PropertyRow(session_.document(), base + QLatin1String(name),
                                 cut ? tr("Split edges") : QString()));
  }
  section->setOpen(meshOpen_);
  connect(section, &Section::toggled, this, [this](bool open) { meshOpen_ = open; });
  return section;
}

QWidget* ObjectSections::makePatch(const QString& base) {
  auto* section = new Section(tr("Patch"));
  section->add(new PropertyRow(session_.document(), base + QStringLiteral("patch"), tr("Carries it")));
  section->setOpen(patchOpen_);
  connect(section, &Section::toggled, this, [this](bool open) { patchOpen_ = open; });
  return section;
}

QWidget* ObjectSections::makeSurroundings(const QString& base) {
  auto* section = new Section(tr("Surroundings"));
  section->add(new PropertyRow(session_.document(), base + QStringLiteral("captured"), tr("Captured")));
  emission_ = new PropertyRow(session_.document(), base + QStringLiteral("emission"), tr("Emission"));
  section->add(emission_);
  section->setOpen(aroundOpen_);
  connect(section, &Section::toggled, this, [this](bool open) { aroundOpen_ = open; });
  return section;
}

void ObjectSections::refresh() {
  const ObjectRecipe* object = selected(session_);
  if (object && isBuiltin(object->mesh.path) != builtin_) return rebuild();
  const bool known = bool(session_.sceneEditor().meshOf(session_.selectedObject()));
  rest_->setEnabled(known);
  centre_->setEnabled(known);
  emission_->setVisible(object && object->captured);
  if (object) size_->setValue(double(sizeOf(object->transform)));
}

}  // namespace prt::ui
