#include "ui/docks/mesh_report.h"

#include "ui/model/defect_view.h"
#include "ui/model/scene_editor.h"
#include "ui/model/session.h"
#include "ui/widgets/theme.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPainter>
#include <QToolButton>
#include <QTreeWidget>

#include <algorithm>

namespace prt::ui {

namespace {

// A filled dot where something matters, a ring where it may be meant; the colours are those of states.
QIcon dot(DefectSeverity severity) {
  const Theme& t = theme();
  const QColor color =
      severity == DefectSeverity::Mended ? t.done : (severity == DefectSeverity::Warning ? t.stale : t.muted);
  QPixmap pixmap(24, 24);
  pixmap.setDevicePixelRatio(2);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  const bool ring = severity == DefectSeverity::Harmless;
  painter.setPen(ring ? QPen(color, 1.5) : QPen(Qt::NoPen));
  painter.setBrush(ring ? QBrush(Qt::NoBrush) : QBrush(color));
  painter.drawEllipse(QPointF(6, 6), ring ? 3.25 : 3.75, ring ? 3.25 : 3.75);
  return QIcon(pixmap);
}

QLabel* wrapped(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(QLatin1String(name));
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  setRole(label, "muted");
  return label;
}

}  // namespace

MeshReport::MeshReport(Session& session, QWidget* parent)
    : Section(tr("Mesh report"), parent),
      session_(session),
      facts_(wrapped("meshReport")),
      lines_(new QTreeWidget),
      stepper_(makeStepper()),
      meaning_(wrapped("defectMeaning")),
      notes_(wrapped("meshNotes")) {
  lines_->setObjectName(QStringLiteral("defectLines"));
  lines_->setHeaderHidden(true);
  lines_->setColumnCount(2);
  lines_->setRootIsDecorated(false);
  lines_->setUniformRowHeights(true);
  lines_->setIconSize({12, 12});
  lines_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  lines_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  lines_->header()->setStretchLastSection(false);
  lines_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  lines_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  for (QWidget* each : {static_cast<QWidget*>(facts_), static_cast<QWidget*>(lines_), stepper_,
                        static_cast<QWidget*>(meaning_), static_cast<QWidget*>(notes_)})
    add(each);
  connect(lines_, &QTreeWidget::itemClicked, this,
          [this](QTreeWidgetItem* item) { clicked(lines_->indexOfTopLevelItem(item)); });
  connect(lines_, &QTreeWidget::itemActivated, this,
          [this](QTreeWidgetItem* item) { clicked(lines_->indexOfTopLevelItem(item)); });
  connect(&session_, &Session::selectionChanged, this, &MeshReport::refill);
  connect(&session_, &Session::meshesChanged, this, &MeshReport::refill);
  connect(&session_.document(), &Document::recipeChanged, this, &MeshReport::refill);
  connect(&session_.defects(), &DefectView::changed, this, &MeshReport::refreshShown);
  refill();
}

QWidget* MeshReport::makeStepper() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  const auto button = [&](const char* name, const char* iconName, const QString& tip, int by) {
    auto* each = new QToolButton;
    each->setObjectName(QLatin1String(name));
    each->setIcon(icon(QLatin1String(iconName)));
    each->setToolTip(tip);
    connect(each, &QToolButton::clicked, this, [this, by] { session_.defects().step(by); });
    layout->addWidget(each);
  };
  place_ = new QLabel;
  place_->setObjectName(QStringLiteral("defectPlace"));
  place_->setAlignment(Qt::AlignCenter);
  button("previousDefect", "go-previous", tr("The one before, alone"), -1);
  layout->addWidget(place_, 1);
  button("nextDefect", "go-next", tr("The next one, alone"), 1);
  return row;
}

void MeshReport::refill() {
  const ObjectMesh found = session_.sceneEditor().meshOf(session_.selectedObject());
  const bool same = filled_ && *filled_ == std::pair(found.product, found.index);
  if (same) return refreshShown();  // every move of a light comes by here
  filled_ = {found.product, found.index};
  lines_->clear();
  kinds_.clear();
  QStringList notes;
  if (!found) {
    facts_->setText(tr("The mesh has not been read yet."));
  } else {
    const std::string facts = found.product->factsText(found.index);
    facts_->setText(facts.empty() ? tr("A built-in mesh: nothing to report.")
                                  : QString::fromStdString(facts));
    for (const std::string& note : found.product->notes(found.index)) notes << QString::fromStdString(note);
    for (const DefectLine& line : found.defects()) {
      const QString name = QString::fromStdString(defectName(line.kind, std::max(line.found, line.left)));
      auto* item = new QTreeWidgetItem({name, QString::fromStdString(line.outcome())});
      item->setIcon(0, dot(line.severity()));
      item->setForeground(1, theme().muted);
      item->setTextAlignment(1, Qt::AlignRight | Qt::AlignVCenter);
      item->setToolTip(
          0, QStringLiteral("<p>%1</p><p>%2</p>").arg(name, QString::fromUtf8(defectMeaning(line.kind))));
      lines_->addTopLevelItem(item);
      kinds_.push_back(line.kind);
    }
    if (!facts.empty() && kinds_.empty()) facts_->setText(facts_->text() + tr("; no defects"));
  }
  lines_->setVisible(!kinds_.empty());
  lines_->setFixedHeight(int(kinds_.size()) * (kRowHeight - 2) + 2);
  notes_->setVisible(!notes.isEmpty());
  notes_->setText(notes.join(u'\n'));
  refreshShown();
}

// The dots have the theme's colours.
void MeshReport::changeEvent(QEvent* event) {
  Section::changeEvent(event);
  if (event->type() != QEvent::PaletteChange || !filled_) return;
  filled_.reset();
  refill();
}

void MeshReport::refreshShown() {
  const auto& shown = session_.defects().shown();
  const bool here = shown && shown->object == session_.selectedObject();
  const auto row =
      here ? std::find(kinds_.begin(), kinds_.end(), shown->kind) - kinds_.begin() : std::ptrdiff_t(-1);
  lines_->setCurrentItem(here && row < std::ptrdiff_t(kinds_.size()) ? lines_->topLevelItem(int(row))
                                                                     : nullptr);
  meaning_->setVisible(here);
  stepper_->setVisible(here && session_.defects().elements() > 1);
  if (!here) return;
  const int count = session_.defects().elements();
  meaning_->setText(QString::fromUtf8(defectMeaning(shown->kind)) +
                    (count == 0 ? tr(" They have no place on the surface.") : QString()));
  place_->setText(shown->element < 0 ? tr("all %1").arg(count)
                                     : tr("%1 of %2").arg(shown->element + 1).arg(count));
}

void MeshReport::clicked(int row) {
  if (row < 0 || row >= int(kinds_.size())) return;
  const DefectKind kind = kinds_[std::size_t(row)];
  const auto& shown = session_.defects().shown();
  if (shown && shown->object == session_.selectedObject() && shown->kind == kind)
    session_.defects().hide();
  else
    session_.defects().show(session_.selectedObject(), kind);
}

}  // namespace prt::ui
