#include "ui/docks/scene_dock.h"

#include "libprt/project/captured_objects.h"
#include "ui/docks/mesh_report.h"
#include "ui/docks/object_sections.h"
#include "ui/model/expression.h"
#include "ui/model/scene_editor.h"
#include "ui/model/scene_edits.h"
#include "ui/model/session.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/theme.h"

#include <QAction>
#include <QCheckBox>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMenu>
#include <QMimeData>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>

namespace prt::ui {

namespace {

constexpr int kLeastRows = 2, kMostRows = 8;  // of the list, before it scrolls
constexpr int kEye = 3, kEyeWidth = 24;       // column, shown first

struct Counts {
  qint64 vertices = 0, triangles = 0;
};

std::vector<Counts> countsOf(const Scene& scene) {
  std::vector<Counts> counts(scene.names.size());
  for (const std::uint32_t object : scene.vertexObject) ++counts[object].vertices;
  for (const std::uint32_t object : scene.triangleObject) ++counts[object].triangles;
  return counts;
}

QStringList meshFiles(const QMimeData& data) {
  QStringList files;
  for (const QUrl& url : data.urls())
    if (url.isLocalFile() && SceneEditor::isMesh(url.toLocalFile())) files << url.toLocalFile();
  return files;
}

}  // namespace

SceneDock::SceneDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      message_(new MessageBar),
      objects_(new QTreeWidget),
      ground_(new QCheckBox(tr("Ground"))),
      duplicate_(new QToolButton),
      remove_(new QToolButton) {
  setAcceptDrops(true);
  makeList();
  makeActions();
  add(makeBar());
  add(message_);
  add(objects_);
  add(new ObjectSections(session_));
  add(new MeshReport(session_));
  message_->hide();
  connect(&session_, &Session::statusChanged, this, &SceneDock::refresh);
  connect(&session_, &Session::selectionChanged, this, &SceneDock::refresh);
  connect(&session_.document(), &Document::recipeChanged, message_, &QWidget::hide);
  connect(&session_.relighter(), &Relighter::sceneChanged, this, &SceneDock::refresh);
  connect(&session_, &Session::message, this, [this](Severity severity, const QString& text, Place place) {
    if (place == Place::Scene) message_->show(severity, text);
  });
  refresh();
}

void SceneDock::makeList() {
  objects_->setObjectName(QStringLiteral("objectList"));
  objects_->setHeaderLabels({tr("Object"), tr("Vertices"), tr("Triangles"), QString()});
  objects_->header()->moveSection(kEye, 0);
  objects_->header()->setMinimumSectionSize(kEyeWidth);
  objects_->header()->setSectionResizeMode(kEye, QHeaderView::Fixed);
  objects_->header()->resizeSection(kEye, kEyeWidth);
  objects_->setRootIsDecorated(false);
  objects_->setUniformRowHeights(true);
  objects_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  objects_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  objects_->header()->setStretchLastSection(false);
  objects_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  objects_->headerItem()->setTextAlignment(0, Qt::AlignLeft | Qt::AlignVCenter);
  for (const int column : {1, 2}) {
    objects_->header()->setSectionResizeMode(column, QHeaderView::ResizeToContents);
    objects_->headerItem()->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
  }
  connect(objects_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item) session_.selectObject(objects_->indexOfTopLevelItem(item));
  });
  connect(objects_, &QTreeWidget::itemClicked, this, [this](QTreeWidgetItem* item, int column) {
    if (column == kEye) toggle(objects_->indexOfTopLevelItem(item));
  });
  // Queued: a rename fills the list anew, and the item that tells of it must outlive its telling.
  connect(objects_, &QTreeWidget::itemChanged, this, [this](QTreeWidgetItem* item, int column) {
    if (column != 0) return;
    const int index = objects_->indexOfTopLevelItem(item);
    QMetaObject::invokeMethod(
        this,
        [this, index, name = item->text(0)] {
          session_.sceneEditor().rename(index, name);
          refresh();
        },
        Qt::QueuedConnection);
  });
}

// The list's actions: keys while it has the focus, and its context menu.
void SceneDock::makeActions() {
  const auto action = [this](const char* iconName, const QString& text, const QKeySequence& key, auto act) {
    auto* each = new QAction(icon(QLatin1String(iconName)), text, objects_);
    each->setShortcut(key);
    each->setShortcutContext(Qt::WidgetShortcut);
    connect(each, &QAction::triggered, this, [this, act] {
      if (current() >= 0) act(current());
    });
    objects_->addAction(each);
    return each;
  };
  action("edit-rename", tr("Rename"), {}, [this](int) { objects_->editItem(objects_->currentItem(), 0); });
  action("view-visible", tr("Hide or show"), QKeySequence(Qt::Key_H), [this](int object) { toggle(object); });
  action("edit-duplicate", tr("Duplicate"), QKeySequence(Qt::CTRL | Qt::Key_D),
         [this](int object) { session_.sceneEditor().duplicate(object); });
  action("edit-delete", tr("Remove"), QKeySequence::Delete,
         [this](int object) { session_.sceneEditor().remove(object); });
  objects_->setContextMenuPolicy(Qt::ActionsContextMenu);
}

QWidget* SceneDock::makeBar() {
  auto* add = new QToolButton;
  add->setObjectName(QStringLiteral("addObject"));
  add->setIcon(icon(QStringLiteral("list-add")));
  add->setText(tr("Add"));
  add->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  add->setPopupMode(QToolButton::InstantPopup);
  add->setToolTip(tr("Add a mesh to the scene; or drop files on the list."));
  auto* menu = new QMenu(add);
  menu->addAction(icon(QStringLiteral("document-open")), tr("From file\u2026"), this,
                  &SceneDock::addFromFile);
  menu->addSeparator();
  for (const QString& name : SceneEditor::builtinMeshes())
    menu->addAction(name, this,
                    [this, name] { session_.sceneEditor().add({QStringLiteral("builtin:") + name}); });
  add->setMenu(menu);

  ground_->setObjectName(QStringLiteral("groundPlane"));
  ground_->setToolTip(tr("A large plane under the scene that takes its shadows."));
  connect(ground_, &QCheckBox::clicked, this, [this](bool on) { session_.sceneEditor().setGround(on); });
  const auto tool = [](QToolButton* button, const char* name, const char* iconName) {
    button->setObjectName(QLatin1String(name));
    button->setIcon(icon(QLatin1String(iconName)));
  };
  tool(duplicate_, "duplicateObject", "edit-duplicate");
  duplicate_->setToolTip(tr("Duplicate the selected object (Ctrl+D)"));
  tool(remove_, "removeObject", "edit-delete");
  connect(duplicate_, &QToolButton::clicked, this, [this] { session_.sceneEditor().duplicate(current()); });
  connect(remove_, &QToolButton::clicked, this, [this] { session_.sceneEditor().remove(current()); });

  auto* bar = new QWidget;
  auto* layout = new QHBoxLayout(bar);
  layout->setContentsMargins(kGrid, 0, 2 * kGrid, 0);
  layout->setSpacing(kGrid / 2);
  layout->addWidget(add);
  layout->addWidget(duplicate_);
  layout->addWidget(remove_);
  layout->addStretch(1);
  layout->addWidget(ground_);
  return bar;
}

void SceneDock::toggle(int object) {
  SceneEditor& editor = session_.sceneEditor();
  if (editor.visible(object) && !editor.canHide(object))
    message_->show(Severity::Info, tr("A scene shows one object at least."));
  editor.setVisible(object, !editor.visible(object));
}

int SceneDock::current() const {
  return objects_->indexOfTopLevelItem(objects_->currentItem());
}

void SceneDock::addFromFile() {
  session_.sceneEditor().add(QFileDialog::getOpenFileNames(
      window(), tr("Add meshes"), {}, tr("Meshes (*.obj *.ply *.off *.stl *.gltf *.glb);;All files (*)")));
}

void SceneDock::dragEnterEvent(QDragEnterEvent* event) {
  if (!meshFiles(*event->mimeData()).isEmpty()) event->acceptProposedAction();
}

void SceneDock::dropEvent(QDropEvent* event) {
  session_.sceneEditor().add(meshFiles(*event->mimeData()));
  event->acceptProposedAction();
}

// Hidden, the name is as faint as a muted light's.
void SceneDock::showEye(QTreeWidgetItem& item, bool visible) {
  if (item.data(kEye, Qt::UserRole) == QVariant(visible)) return;
  item.setData(kEye, Qt::UserRole, visible);
  item.setIcon(kEye, icon(visible ? QStringLiteral("view-visible") : QStringLiteral("view-hidden")));
  item.setToolTip(kEye, visible ? tr("Hide the object: it takes no part in bake and picture (H).")
                                : tr("Show the object again (H)."));
  for (const int column : {0, 1, 2})
    item.setData(column, Qt::ForegroundRole, visible ? QVariant() : QVariant(theme().muted));
}

void SceneDock::refresh() {
  const QSignalBlocker quiet(objects_);
  const Recipe& recipe = session_.document().recipe();
  const auto& scene = session_.relighter().scene();
  std::vector<Counts> counts = scene ? countsOf(*scene) : std::vector<Counts>{};
  const bool sameScene = counts.size() == recipe.objects.size();
  while (objects_->topLevelItemCount() > int(recipe.objects.size())) delete objects_->takeTopLevelItem(0);
  while (objects_->topLevelItemCount() < int(recipe.objects.size())) {
    auto* item = new QTreeWidgetItem;
    item->setFlags(item->flags() | Qt::ItemIsEditable);
    for (const int column : {1, 2}) item->setTextAlignment(column, Qt::AlignRight | Qt::AlignVCenter);
    objects_->addTopLevelItem(item);
  }
  for (std::size_t i = 0; i < recipe.objects.size(); ++i) {
    QTreeWidgetItem* item = objects_->topLevelItem(int(i));
    item->setText(0, QString::fromStdString(recipe.objects[i].name));
    const QString path = QString::fromStdString(recipe.objects[i].mesh.path);
    item->setToolTip(
        0, isCaptured(recipe.objects[i]) ? tr("%1: captured, moves without a bake").arg(path) : path);
    showEye(*item, recipe.objects[i].visible);
    if (isCaptured(recipe.objects[i]) && sameScene) {
      const ObjectMesh found = session_.sceneEditor().meshOf(int(i));
      if (found) counts[i] = {qint64(found.mesh().vertexCount()), qint64(found.mesh().triangleCount())};
    }
    const bool counted = sameScene && recipe.objects[i].visible;
    item->setText(1, counted ? formatCount(counts[i].vertices) : QStringLiteral("\u2013"));
    item->setText(2, counted ? formatCount(counts[i].triangles) : QStringLiteral("\u2013"));
  }
  objects_->setCurrentItem(objects_->topLevelItem(session_.selectedObject()));
  const int rows = std::clamp(int(recipe.objects.size()), kLeastRows, kMostRows);
  objects_->setFixedHeight((rows + 1) * kRowHeight + 2);
  const bool removable = session_.sceneEditor().canRemove(session_.selectedObject());
  remove_->setEnabled(removable);
  remove_->setToolTip(removable ? tr("Remove the selected object (Del)")
                                : tr("A scene shows one object at least."));
  ground_->setChecked(session_.sceneEditor().hasGround());
  const int ground = groundObject(recipe);
  ground_->setEnabled(ground < 0 || session_.sceneEditor().canRemove(ground));
}

}  // namespace prt::ui
