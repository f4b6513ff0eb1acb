#include "ui/docks/material_dock.h"

#include "ui/model/session.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QComboBox>
#include <QVBoxLayout>

namespace prt::ui {

MaterialDock::MaterialDock(Session& session, QWidget* parent)
    : DockColumn(parent), session_(session), objects_(new QComboBox) {
  objects_->setToolTip(tr("The object whose material is edited; the same selection as in the scene list."));
  auto* head = new QWidget;
  auto* layout = new QVBoxLayout(head);
  layout->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, 0);
  layout->addWidget(objects_);
  add(head);
  connect(objects_, &QComboBox::activated, &session_, &Session::selectObject);
  connect(&session_, &Session::selectionChanged, this, &MaterialDock::showObject);
  connect(&session_.document(), &Document::recipeChanged, this, &MaterialDock::refreshObjects);
  refreshObjects();
  showObject(session_.selectedObject());
}

void MaterialDock::showObject(int object) {
  delete rows_;
  rows_ = new QWidget;
  auto* layout = new QVBoxLayout(rows_);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  const QString base = QStringLiteral("objects[%1].material.").arg(object);
  const auto section = [&](const QString& title, std::initializer_list<const char*> names) {
    auto* group = new Section(title);
    for (const char* name : names) group->add(new PropertyRow(session_.document(), base + QLatin1String(name)));
    layout->addWidget(group);
  };
  section(tr("Diffuse"), {"model", "albedo"});
  section(tr("Specular"), {"specular", "exponent"});
  section(tr("Surface"), {"twoSided"});
  add(rows_);
  objects_->setCurrentIndex(object);
}

void MaterialDock::refreshObjects() {
  const Recipe& recipe = session_.document().recipe();
  objects_->clear();
  for (const ObjectRecipe& object : recipe.objects) objects_->addItem(QString::fromStdString(object.name));
  objects_->setCurrentIndex(session_.selectedObject());
}

}  // namespace prt::ui
