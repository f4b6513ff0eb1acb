#include "ui/docks/scene_dock.h"

#include "ui/model/expression.h"
#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <QHeaderView>
#include <QLabel>
#include <QTreeWidget>

namespace prt::ui {

namespace {

struct Counts {
  qint64 vertices = 0, triangles = 0;
};

std::vector<Counts> countsOf(const Scene& scene) {
  std::vector<Counts> counts(scene.names.size());
  for (const std::uint32_t object : scene.vertexObject) ++counts[object].vertices;
  for (const std::uint32_t object : scene.triangleObject) ++counts[object].triangles;
  return counts;
}

}  // namespace

SceneDock::SceneDock(Session& session, QWidget* parent)
    : DockColumn(parent), session_(session), objects_(new QTreeWidget), report_(new QLabel) {
  objects_->setHeaderLabels({tr("Object"), tr("Vertices"), tr("Triangles")});
  objects_->setRootIsDecorated(false);
  objects_->setUniformRowHeights(true);
  objects_->header()->setStretchLastSection(false);
  objects_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  objects_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  objects_->header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
  objects_->headerItem()->setTextAlignment(1, Qt::AlignRight);
  objects_->headerItem()->setTextAlignment(2, Qt::AlignRight);
  objects_->setMinimumHeight(96);
  connect(objects_, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (item) session_.selectObject(objects_->indexOfTopLevelItem(item));
  });
  addFilling(objects_);

  auto* section = new Section(tr("Mesh report"));
  report_->setWordWrap(true);
  report_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  setRole(report_, "muted");
  report_->setObjectName(QStringLiteral("meshReport"));
  section->add(report_);
  add(section);

  connect(&session_, &Session::statusChanged, this, &SceneDock::refresh);
  connect(&session_.relighter(), &Relighter::sceneChanged, this, &SceneDock::refresh);
  refresh();
}

void SceneDock::refresh() {
  const QSignalBlocker quiet(objects_);
  objects_->clear();
  const Recipe& recipe = session_.document().recipe();
  const auto& scene = session_.relighter().scene();
  const std::vector<Counts> counts = scene ? countsOf(*scene) : std::vector<Counts>{};
  for (std::size_t i = 0; i < recipe.objects.size(); ++i) {
    const bool known = i < counts.size();
    auto* item = new QTreeWidgetItem({QString::fromStdString(recipe.objects[i].name),
                                      known ? formatCount(counts[i].vertices) : QStringLiteral("\u2013"),
                                      known ? formatCount(counts[i].triangles) : QStringLiteral("\u2013")});
    item->setToolTip(0, QString::fromStdString(recipe.objects[i].mesh.path));
    item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
    item->setTextAlignment(2, Qt::AlignRight | Qt::AlignVCenter);
    objects_->addTopLevelItem(item);
    if (int(i) == session_.selectedObject()) objects_->setCurrentItem(item);
  }
  const QStringList& reports = session_.meshReports();
  report_->setText(reports.isEmpty() ? tr("No mesh has been read yet.") : reports.join(u'\n'));
}

}  // namespace prt::ui
