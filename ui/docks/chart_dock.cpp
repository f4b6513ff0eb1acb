#include "ui/docks/chart_dock.h"

#include "ui/docks/jobs_dock.h"
#include "ui/model/chart_editor.h"
#include "ui/model/session.h"
#include "ui/widgets/chart_view.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QPushButton>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <cmath>

namespace prt::ui {

namespace {

constexpr int kMostFaults = 6;  // that are listed; all are on the model

// Side by side, in equal parts of however narrow the dock is.
QHBoxLayout* side(std::initializer_list<QWidget*> widgets) {
  auto* row = new QHBoxLayout;
  row->setContentsMargins(0, 2, 0, 2);
  row->setSpacing(kGrid);
  for (QWidget* each : widgets) {
    each->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    row->addWidget(each, 1);
  }
  return row;
}

QString number(double value, int decimals) {
  return QLocale().toString(value, 'f', decimals);
}

}  // namespace

ChartDock::ChartDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      charts_(session.charts()),
      view_(new ChartView(charts_)),
      shown_(new QComboBox),
      shade_(new QComboBox),
      numbers_(new QLabel),
      state_(new QLabel),
      bar_(new QProgressBar),
      message_(new MessageBar),
      faults_(new QWidget) {
  add(makeAtlas());
  add(makeCut());
  add(makeChart());
  add(makeFlat());
  add(makePack());
  connect(&charts_, &ChartEditor::changed, this, &ChartDock::refresh);
  connect(&charts_, &ChartEditor::cutChanged, this, &ChartDock::refresh);
  connect(&charts_, &ChartEditor::selectionChanged, this, &ChartDock::refreshChart);
  connect(&charts_, &ChartEditor::told, this, [this](const QString& text, bool error) {
    message_->show(error ? Severity::Error : Severity::Info, text);
    session_.log().add(error ? Severity::Error : Severity::Info, text);
  });
  connect(&session_.document(), &Document::recipeChanged, message_, &QWidget::hide);
  connect(&session_.document(), &Document::recipeChanged, this, &ChartDock::refresh);
  connect(&session_.jobs(), &JobRunner::changed, this, [this](quint64 id) {
    if (id == charts_.job()) refreshNumbers();
  });
  refresh();
}

QPushButton* ChartDock::makeButton(const char* name, const QString& text, const QString& tip,
                                   std::function<void()> run) {
  auto* button = new QPushButton(text);
  button->setObjectName(QLatin1String(name));
  button->setToolTip(tip);
  connect(button, &QPushButton::clicked, this, [run = std::move(run)] { run(); });
  return button;
}

Section* ChartDock::makeAtlas() {
  auto* section = new Section(tr("Atlas"));
  shown_->setObjectName(QStringLiteral("chartShown"));
  shown_->addItems({tr("Atlas"), tr("One chart")});
  shown_->setToolTip(
      tr("All charts where they lie in the atlas, or the selected one alone with its corners."));
  connect(shown_, &QComboBox::activated, view_, [this](int index) { view_->setShowsOne(index == 1); });
  connect(view_, &ChartView::showsOneChanged, shown_,
          [this](bool one) { shown_->setCurrentIndex(one ? 1 : 0); });
  shade_->setObjectName(QStringLiteral("chartShade"));
  for (int i = 0; i <= int(ChartShade::Density); ++i) shade_->addItem(nameOf(ChartShade(i)));
  shade_->setToolTip(
      tr("What the surface and the atlas show: charts in hues of their own, a checkerboard of the texture, "
         "the L2 "
         "stretch, or texels per area against the mean. Off: the lit surface."));
  connect(shade_, &QComboBox::activated, &charts_,
          [this](int index) { charts_.setShade(ChartShade(index)); });
  for (QComboBox* box : {shown_, shade_}) {  // the column may be narrow
    box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    box->setMinimumContentsLength(8);
  }
  section->addLayout(side({shown_, shade_}));
  section->add(view_);
  setRole(numbers_, "muted");
  numbers_->setObjectName(QStringLiteral("chartNumbers"));
  numbers_->setWordWrap(true);
  numbers_->setToolTip(
      tr("L2 and L\u221e stretch of Sander et al. over the whole atlas, 1 = isometric; length of all "
         "seams relative to the root of the surface's area; part of the atlas that is filled."));
  section->add(numbers_);
  state_->setObjectName(QStringLiteral("chartState"));
  state_->setWordWrap(true);
  section->add(state_);
  bar_->setObjectName(QStringLiteral("chartProgress"));
  bar_->setTextVisible(false);
  bar_->setFixedHeight(kGrid);
  section->add(bar_);
  cancel_ = makeButton("chartCancel", tr("Cancel"), tr("Stops what is being worked on; what is there stays."),
                       [this] { charts_.cancelJob(); });
  cancel_->setIcon(icon(QStringLiteral("process-stop")));
  section->add(cancel_);
  section->add(message_);
  message_->hide();
  return section;
}

Section* ChartDock::makeCut() {
  auto* section = new Section(tr("Cut"));
  cut_ = makeButton(
      "chartCut", tr("Draw cuts"),
      tr("The knife (K): click on the model, each click cuts the shortest way from the last one. Ctrl "
         "erases, Esc leaves."),
      [this] { charts_.setCutting(!charts_.cutting()); });
  cut_->setCheckable(true);
  auto_ = makeButton(
      "chartAuto", tr("Auto cut"),
      tr("Few charts, each a disk, with seams in creases and valleys and the stretch below the bound. "
         "The cuts are yours then."),
      [this] { charts_.autoCut(); });
  section->addLayout(side({cut_, auto_}));
  creases_ = new QCheckBox(tr("Cuts follow creases"));
  creases_->setObjectName(QStringLiteral("chartCreases"));
  creases_->setToolTip(
      tr("On, the way between two clicks keeps to edges where the surface bends; off, it is the "
         "shortest."));
  connect(creases_, &QCheckBox::toggled, &charts_, &ChartEditor::setFollowCreases);
  section->add(creases_);
  auto* rows = new QVBoxLayout(faults_);
  rows->setContentsMargins(0, kGrid, 0, kGrid);
  rows->setSpacing(2);
  faults_->setObjectName(QStringLiteral("chartFaults"));
  section->add(faults_);
  mend_ = makeButton("chartMend", tr("Cut as suggested"),
                     tr("Makes the suggested cuts (dashed on the model): every chart is a disk then."),
                     [this] { charts_.applyAllSuggestions(); });
  clear_ = makeButton("chartClear", tr("Remove all cuts"), tr("Takes all cuts of all objects away."),
                      [this] { charts_.removeAllCuts(); });
  section->add(mend_);
  section->add(clear_);
  for (const char* path : {"charts.mode", "charts.stretch", "charts.creases"})
    section->add(new PropertyRow(session_.document(), QLatin1String(path)));
  return section;
}

Section* ChartDock::makeChart() {
  chart_ = new Section(tr("Selected chart"));
  chartFacts_ = new QLabel;
  chartFacts_->setObjectName(QStringLiteral("chartFacts"));
  chartFacts_->setWordWrap(true);
  setRole(chartFacts_, "muted");
  chart_->add(chartFacts_);
  weight_ = new NumberField({.low = 0.001, .high = 1000, .decimals = 3, .logarithmic = true, .unit = {}});
  weight_->setObjectName(QStringLiteral("chartWeight"));
  corners_ = new NumberField({.low = 0, .high = 64, .decimals = 0, .unit = {}, .step = 1});
  corners_->setObjectName(QStringLiteral("chartCorners"));
  for (NumberField* field : {weight_, corners_}) {
    connect(field, &NumberField::gestureBegan, this, [this, field] {
      charts_.beginMove(field == weight_ ? tr("Weight of chart") : tr("Corners of chart"));
    });
    connect(field, &NumberField::gestureEnded, this, [this] { charts_.endMove(); });
  }
  connect(weight_, &NumberField::edited, this,
          [this](double v) { charts_.setWeight(charts_.selected(), v); });
  connect(weight_, &NumberField::resetRequested, this, [this] { charts_.setWeight(charts_.selected(), 1); });
  connect(corners_, &NumberField::edited, this,
          [this](double v) { charts_.setCornerCount(charts_.selected(), int(std::lround(v))); });
  connect(corners_, &NumberField::resetRequested, this,
          [this] { charts_.setCornerCount(charts_.selected(), 0); });
  chart_->add(fieldRow(tr("Weight"), weight_, tr("Texels per area relative to other charts.")));
  chart_->add(fieldRow(
      tr("Corners"), corners_,
      tr("Of the polygon that its boundary is laid on; 0: as all charts. Where they are is dragged in "
         "\u201cOne chart\u201d.")));
  locked_ = new QCheckBox(tr("Stays where it is"));
  locked_->setObjectName(QStringLiteral("chartLocked"));
  locked_->setToolTip(tr("Locked: neither dragging nor packing moves it."));
  connect(locked_, &QCheckBox::clicked, this, [this](bool on) { charts_.setLocked(charts_.selected(), on); });
  chart_->add(locked_);
  return chart_;
}

Section* ChartDock::makeFlat() {
  auto* section = new Section(tr("Lay flat"));
  for (const char* path : {"charts.boundary", "charts.corners"})
    section->add(new PropertyRow(session_.document(), QLatin1String(path)));
  flatten_ = makeButton("chartFlatten", tr("Lay flat anew"), tr("Every chart from the beginning."),
                        [this] { charts_.flattenAll(); });
  section->add(flatten_);
  return section;
}

Section* ChartDock::makePack() {
  auto* section = new Section(tr("Pack"));
  for (const char* path : {"atlas.size", "atlas.gutter", "atlas.turns"})
    section->add(new PropertyRow(session_.document(), QLatin1String(path)));
  pack_ = makeButton(
      "chartPack", tr("Pack"),
      tr("Everything anew that is not locked, as large as goes in; what was put by hand is packed too."),
      [this] { charts_.packAll(); });
  section->add(pack_);
  import_ = makeButton(
      "chartImport", tr("Import UVs"),
      tr("The meshes' own texture coordinates as the atlas. Where they overlap it is shown, and refused "
         "when baked. A cut makes them yours to change."),
      [this] { charts_.useImported(); });
  export_ = makeButton("chartExport", tr("Export UVs\u2026"),
                       tr("The mesh with the atlas as its texture coordinates: OBJ, glTF or GLB."),
                       [this] { exportCoordinates(); });
  section->addLayout(side({import_, export_}));
  return section;
}

void ChartDock::exportCoordinates() {
  const QString file = QFileDialog::getSaveFileName(
      this, tr("Export texture coordinates"), session_.document().title() + QStringLiteral("-atlas.obj"),
      tr("OBJ (*.obj);;glTF (*.gltf *.glb)"));
  if (!file.isEmpty()) charts_.exportCoordinates(file);
}

void ChartDock::showEvent(QShowEvent* event) {
  DockColumn::showEvent(event);
  charts_.setWatched(this, true);
}

void ChartDock::hideEvent(QHideEvent* event) {
  DockColumn::hideEvent(event);
  charts_.setWatched(this, false);
}

// ---- what it shows ----

void ChartDock::refresh() {
  const bool cutByHand = charts_.ready() && charts_.seams().count() > 0;
  const bool imported = session_.document().recipe().charts.mode == ChartsMode::Imported;
  shade_->setCurrentIndex(int(charts_.shade()));
  cut_->setChecked(charts_.cutting());
  creases_->setChecked(charts_.followCreases());
  auto_->setEnabled(charts_.ready() && !charts_.autoCutting());
  clear_->setEnabled(cutByHand);
  flatten_->setEnabled(!charts_.items().empty() && !imported);
  pack_->setEnabled(!charts_.items().empty() && !imported);
  import_->setEnabled(charts_.hasCoordinates() && !imported);
  export_->setEnabled(charts_.atlas() != nullptr);
  refreshNumbers();
  refreshFaults();
  refreshChart();
}

void ChartDock::refreshNumbers() {
  const ChartNumbers n = charts_.numbers();
  QString text;
  if (n.charts > 0) {
    text = tr("Charts: %1   L2 %2   L\u221e %3\nSeams %4   Filled %5")
               .arg(n.charts)
               .arg(number(n.l2, 3), number(n.lInf, 2), number(n.seam, 2))
               .arg(n.filled >= 0 ? tr("%1 %").arg(number(100 * n.filled, 1)) : QStringLiteral("\u2026"));
  }
  numbers_->setText(text);
  numbers_->setVisible(!text.isEmpty());

  const JobInfo* job = session_.jobs().find(charts_.job());
  const bool working = job && !job->over();
  bar_->setVisible(working);
  cancel_->setVisible(working);
  QStringList lines;
  if (working) {
    bar_->setRange(0, 1000);
    bar_->setValue(int(std::lround(1000 * job->progress.fraction())));
    if (!job->progress.phase.empty()) lines << QString::fromStdString(job->progress.phase);
  }
  if (n.overlaps > 0) lines << tr("Charts that overlap or leave the square: %1.").arg(n.overlaps);
  lines << charts_.problems();
  if (!charts_.error().isEmpty()) lines << charts_.error();
  const bool wrong = n.overlaps > 0 || !charts_.problems().isEmpty() || !charts_.error().isEmpty();
  setRole(state_, wrong ? "failed" : "muted");
  state_->setText(lines.join(u'\n'));
  state_->setVisible(!lines.isEmpty());
}

// One line per chart that cannot be laid flat, why, and the cut that mends it; and one for the chart that
// stretches most where the bound is missed.
void ChartDock::refreshFaults() {
  QStringList texts;
  std::vector<int> which;
  bool suggested = false;
  for (int c = 0; c < int(charts_.items().size()); ++c) {
    const ChartItem& item = charts_.items()[std::size_t(c)];
    if (!item.bad()) continue;
    suggested = suggested || !item.suggestion.empty();
    which.push_back(c);
    texts << tr("Chart %1: %2").arg(c + 1).arg(item.fault.isEmpty() ? item.error : item.fault) +
                 (item.suggestion.empty() ? QString() : QStringLiteral(" "));
  }
  mend_->setEnabled(suggested);
  mend_->setVisible(!texts.isEmpty());
  if (const ChartNumbers n = charts_.numbers(); n.stretched >= 0) {
    which.push_back(n.stretched);
    const ChartItem& item = charts_.items()[std::size_t(n.stretched)];
    texts << tr("Chart %1: L2 %2, all %3, bound %4")
                 .arg(n.stretched + 1)
                 .arg(number(item.map->stretch.l2(), 2), number(n.l2, 2),
                      number(double(session_.document().recipe().charts.stretch), 2));
  }
  if (texts == faultTexts_) return;
  faultTexts_ = texts;
  qDeleteAll(faults_->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly));
  auto* rows = static_cast<QVBoxLayout*>(faults_->layout());
  for (int i = 0; i < int(texts.size()) && i < kMostFaults; ++i) {
    auto* line = new QWidget;
    auto* layout = new QHBoxLayout(line);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(kGrid);
    auto* text = new QToolButton;
    text->setText(texts[i].trimmed());
    text->setToolTip(tr("Selects the chart."));
    text->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    text->setToolButtonStyle(Qt::ToolButtonTextOnly);
    text->setObjectName(QStringLiteral("chartFault"));
    connect(text, &QToolButton::clicked, &charts_, [this, c = which[std::size_t(i)]] { charts_.select(c); });
    layout->addWidget(text, 1);
    if (texts[i].endsWith(u' '))
      layout->addWidget(makeButton("chartMendOne", tr("Cut"),
                                   tr("Makes the suggested cut, dashed on the model."),
                                   [this, c = which[std::size_t(i)]] { charts_.applySuggestion(c); }));
    rows->addWidget(line);
  }
  if (texts.size() > kMostFaults)
    rows->addWidget(new QLabel(tr("and %1 more").arg(texts.size() - kMostFaults)));
  faults_->setVisible(!texts.isEmpty());
}

void ChartDock::refreshChart() {
  const int c = charts_.selected();
  // It keeps its place without a selection: nothing jumps when a chart is clicked.
  const std::array<QWidget*, 3> fields{weight_, corners_, locked_};
  if (c < 0) {
    chartFacts_->setText(tr("None: click one on the model or in the atlas.\n"));
    weight_->setValue(1);
    corners_->setValue(0);
    locked_->setChecked(false);
    for (QWidget* each : fields) each->setEnabled(false);
    return;
  }
  const ChartItem& item = charts_.items()[std::size_t(c)];
  QString facts =
      tr("Chart %1, triangles: %2")
          .arg(c + 1)
          .arg(QLocale().toString(qulonglong(charts_.charts().charts[std::size_t(c)].faces.size())));
  if (item.bad())
    facts += u'\n' + (item.fault.isEmpty() ? item.error : item.fault);
  else if (item.map)
    facts += tr("\nL2 %1   L\u221e %2%3")
                 .arg(number(item.map->stretch.l2(), 3), number(item.map->stretch.lInf(), 2),
                      item.map->final ? QString() : QStringLiteral(" \u2026"));
  chartFacts_->setText(facts);
  weight_->setValue(item.settings.weight);
  corners_->setValue(item.settings.corners.empty() ? item.settings.cornerCount
                                                   : double(item.settings.corners.size()));
  locked_->setChecked(item.settings.locked);
  for (QWidget* each : fields) each->setEnabled(charts_.movable() && item.fault.isEmpty());
}

}  // namespace prt::ui
