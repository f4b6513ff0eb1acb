#include "ui/main_window.h"

#include "libprt/project/laid_patch.h"
#include "ui/docks/chart_dock.h"
#include "ui/docks/jobs_dock.h"
#include "ui/docks/light_dock.h"
#include "ui/docks/log_dock.h"
#include "ui/docks/material_dock.h"
#include "ui/docks/patch_dock.h"
#include "ui/docks/rtt_dock.h"
#include "ui/docks/scene_dock.h"
#include "ui/docks/synthesis_dock.h"
#include "ui/docks/transfer_dock.h"
#include "ui/document_menu.h"
#include "ui/model/chart_editor.h"
#include "ui/model/session.h"
#include "ui/viewport/cut_tool.h"
#include "ui/viewport/light_handles.h"
#include "ui/viewport/spot_brush.h"
#include "ui/viewport/stroke_brush.h"
#include "ui/viewport/view_actions.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/chart_view.h"
#include "ui/widgets/dock_title.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/recovery_bar.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/workflow_strip.h"
#include "ui/window/command_palette.h"
#include "ui/window/commands.h"
#include "ui/window/keys_overlay.h"
#include "ui/window/layouts.h"
#include "ui/window/menus.h"
#include "ui/window/status_line.h"

#include <QBuffer>
#include <QCloseEvent>
#include <QDockWidget>
#include <QLayout>
#include <QMenuBar>
#include <QPointer>
#include <QSettings>
#include <QStatusBar>
#include <QStatusTipEvent>

#include <memory>
#include <utility>

namespace prt::ui {

namespace {

constexpr int kLayoutVersion = 4;  // raised when the docks change, so that old layouts are not restored
constexpr int kRecoveryTop = 72;   // below what the corners of the picture say
constexpr int kRecoveryWidth = 640;
constexpr int kThumbWidth = 192, kThumbHeight = 120;
constexpr int kDefaultWidth = 1440, kDefaultHeight = 900;

QByteArray thumbnailOf(Viewport& viewport) {
  const QImage picture = viewport.canvas().grabPicture();
  if (picture.isNull()) return {};
  QByteArray png;
  QBuffer buffer(&png);
  picture.scaled(kThumbWidth, kThumbHeight, Qt::KeepAspectRatio, Qt::SmoothTransformation)
      .save(&buffer, "PNG");
  return png;
}

// As high as what is written in it needs at this width.
void setWidth(QWidget& bar, int width) {
  bar.setFixedWidth(width);
  bar.layout()->activate();
  bar.resize(width, bar.layout()->hasHeightForWidth() ? bar.layout()->totalHeightForWidth(width)
                                                      : bar.sizeHint().height());
}

}  // namespace

MainWindow::MainWindow(Session& session, bool freshLayout)
    : session_(session),
      documents_(new DocumentMenu(session, *this)),
      viewport_(new Viewport(session)),
      viewActions_(new ViewActions(session, *viewport_, !freshLayout, this)),
      lightHandles_(
          new LightHandles(session.lights(), session.rays(), [&session] { return session.bounds(); })),
      cutTool_(new CutTool(session.charts(), session.rays(),
                           [this](const QPointF& at) { return viewport_->pick(at); })),
      strokeBrush_(new StrokeBrush(session.field(), session.painting(),
                                   [this](const QPointF& at) { return viewport_->pick(at); })),
      wishBrush_(wishBrush(session, [this](const QPointF& at) { return viewport_->pick(at); })),
      layerBrush_(layerBrush(session, [this](const QPointF& at) { return viewport_->pick(at); })),
      message_(new MessageBar(viewport_)),
      recovery_(new RecoveryBar(session.project(), viewport_)),
      strip_(new WorkflowStrip),
      layouts_(new Layouts(*this, layoutPlans(), kLayoutVersion)),
      statusLine_(new StatusLine(session, *viewport_, *statusBar())) {
  setObjectName(QStringLiteral("studio"));
  setCentralWidget(viewport_);
  // Tools come before what they work among.
  viewport_->addManipulator(cutTool_);
  viewport_->addManipulator(strokeBrush_);
  viewport_->addManipulator(wishBrush_);
  viewport_->addManipulator(layerBrush_);
  viewport_->addManipulator(lightHandles_);
  setDockOptions(AllowNestedDocks | AllowTabbedDocks | GroupedDragging);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  makeDocks();
  makeSheets();
  makeMenus(*this, {session_, *documents_, *viewActions_, *lightHandles_, *chartDock_,
                    [this] { bringToFront(QStringLiteral("charts")); },
                    [this] { bringToFront(QStringLiteral("synthesis")); }, *layouts_, *strip_, *palette_,
                    *keys_, docks_});
  resize(kDefaultWidth, kDefaultHeight);
  if (freshLayout) {
    layouts_->reset();
  } else {
    QSettings settings;
    restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
    layouts_->restore(settings);
  }

  connect(&session_, &Session::message, this, [this](Severity severity, const QString& text, Place place) {
    if (place != Place::Viewport) return;
    message_->show(severity, text);
    placeMessage();
  });
  connect(viewport_, &Viewport::menuRequested, this, [this](const QPoint& at) {
    auto* menu = new QMenu(this);
    menu->setAttribute(Qt::WA_DeleteOnClose);
    menu->setToolTipsVisible(true);
    viewActions_->fillContextMenu(*menu);
    menu->popup(at);
  });
  connect(&session_.document(), &Document::opened, message_, &QWidget::hide);
  connect(&session_.document(), &Document::stateChanged, this, &MainWindow::refreshTitle);
  connect(&session_.project(), &ProjectKeeper::linksChanged, this, &MainWindow::showLinks);
  connect(recovery_, &RecoveryBar::resized, this, &MainWindow::placeMessage);
  session_.project().autosave().setThumbnail(
      [view = QPointer(viewport_)] { return view ? thumbnailOf(*view) : QByteArray(); });
  connect(&session_, &Session::statusChanged, strip_, &WorkflowStrip::refresh);
  connect(&session_.charts(), &ChartEditor::changed, strip_, &WorkflowStrip::refresh);
  // The knife's keys are the viewport's, wherever it was taken from.
  connect(&session_.charts(), &ChartEditor::cutChanged, this, [this, cutting = false]() mutable {
    const bool now = session_.charts().cutting();
    if (now && !std::exchange(cutting, now)) viewport_->setFocus();
    cutting = now;
  });
  // So are the brushes'.
  connect(&session_.painting(), &Painting::brushChanged, this, [this] {
    if (session_.painting().brush() != Brush::None) viewport_->setFocus();
  });
  // A chart is selected where it is clicked, on the model too.
  connect(viewport_, &Viewport::clicked, this, [this](const QPointF& at, Qt::KeyboardModifiers) {
    if (!session_.charts().watched()) return;
    const auto hit = viewport_->pick(at);
    session_.charts().select(hit ? session_.charts().chartAt(hit->triangle) : -1);
  });
  connect(&session_.relighter(), &Relighter::environmentChanged, strip_, &WorkflowStrip::refresh);
  refreshTitle();
  viewport_->setFocus();
}

// A window that is destroyed while it is shown hides its docks when its layout is gone already, and each
// tells that it is hidden: nobody may ask the layout then which docks share tabs.
MainWindow::~MainWindow() {
  for (QDockWidget* dock : docks_) dock->disconnect(this);
}

QDockWidget* MainWindow::addDock(const QString& title, const QString& name, QWidget* content,
                                 Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title);
  dock->setObjectName(name);
  dock->setWidget(content);
  auto* bar = new DockTitle(dock);
  dock->setTitleBarWidget(bar);
  const auto fold = [this, dock, bar] {
    bar->setFolded(!dock->isFloating() && !tabifiedDockWidgets(dock).isEmpty());
  };
  connect(dock, &QDockWidget::visibilityChanged, this, fold);
  connect(dock, &QDockWidget::dockLocationChanged, this, fold);
  connect(dock, &QDockWidget::topLevelChanged, this, fold);
  addDockWidget(area, dock);
  docks_ << dock;
  return dock;
}

void MainWindow::makeDocks() {
  QDockWidget* scene =
      addDock(tr("Scene"), QStringLiteral("scene"), new SceneDock(session_), Qt::LeftDockWidgetArea);
  QDockWidget* light =
      addDock(tr("Light"), QStringLiteral("light"), new LightDock(session_), Qt::LeftDockWidgetArea);
  addDock(tr("Jobs"), QStringLiteral("jobs"), new JobsDock(session_.jobs()), Qt::LeftDockWidgetArea);
  addDock(tr("Log"), QStringLiteral("log"), new LogDock(session_.log()), Qt::LeftDockWidgetArea);
  addDock(tr("Material"), QStringLiteral("material"), new MaterialDock(session_), Qt::RightDockWidgetArea);
  QDockWidget* transfer = addDock(tr("Transfer"), QStringLiteral("transfer"), new TransferDock(session_),
                                  Qt::RightDockWidgetArea);

  chartDock_ = new ChartDock(session_);
  QDockWidget* charts = addDock(tr("Charts"), QStringLiteral("charts"), chartDock_, Qt::RightDockWidgetArea);
  QDockWidget* patch =
      addDock(tr("Patch"), QStringLiteral("patch"), new PatchDock(session_), Qt::RightDockWidgetArea);
  addDock(tr("RTT"), QStringLiteral("rtt"), new RttDock(session_), Qt::RightDockWidgetArea);
  QDockWidget* synthesis = addDock(tr("Synthesis"), QStringLiteral("synthesis"), new SynthesisDock(session_),
                                   Qt::RightDockWidgetArea);

  const auto bring = [this](QDockWidget* dock) {
    return [this, name = dock->objectName()] { bringToFront(name); };
  };
  const auto stage = [this](std::initializer_list<const char*> names) {
    QStringList list;
    for (const char* name : names) list << QString::fromLatin1(name);
    return [this, list] { return session_.bakes().worstStatus(list); };
  };
  strip_->addStep(tr("Mesh"), tr("The objects, read and repaired."), stage({"mesh"}), bring(scene));
  strip_->addStep(
      tr("Charts"), tr("The surface cut into charts, laid flat and packed."),
      [this, baked = stage({"charts", "atlas"})] {
        const ChartNumbers n = session_.charts().numbers();
        if (n.charts == 0 && showsPatch(session_.document().recipe())) return baked();
        if (n.charts == 0) return ProductStatus::Missing;
        if (n.notDisks + n.overlaps > 0 || !session_.charts().problems().isEmpty())
          return ProductStatus::Failed;
        return n.final ? ProductStatus::Fresh : ProductStatus::Baking;
      },
      bring(charts));
  const auto meso = stage({"patch", "rtt"});
  strip_->addStep(
      tr("Patch"), tr("The surface's fine structure and how it answers to light."),
      [this, meso] {
        const bool none = session_.document().recipe().patch.model == PatchModel::None;
        return none ? ProductStatus::Missing : meso();
      },
      bring(patch));
  const auto laid = stage({"field", "layers", "synthesis", "idmap"});
  strip_->addStep(
      tr("Synthesis"), tr("The patch laid over the surface."),
      [this, laid] { return showsPatch(session_.document().recipe()) ? laid() : ProductStatus::Missing; },
      bring(synthesis));
  strip_->addStep(tr("Transfer"), tr("What is baked for the surface."), stage({"direct", "transfer"}),
                  bring(transfer));
  strip_->addStep(
      tr("Light"), tr("The environment that shines on it."),
      [this] { return session_.relighter().environment() ? ProductStatus::Fresh : ProductStatus::Missing; },
      bring(light));
}

void MainWindow::resetLayout() {
  layouts_->reset();
}

void MainWindow::makeSheets() {
  palette_ = new CommandPalette(
      this,
      [this] {
        return collectCommands(*this, session_, [this](const QString& line) { palette_->openWith(line); });
      },
      [this](const QString& line) { return assignment(session_, line); });
  keys_ = new KeysOverlay(this, [this] { return bindings(); });
}

QList<BindingGroup> MainWindow::bindings() const {
  QList<BindingGroup> groups{{tr("Viewport"), viewport_->bindings()},
                             {tr("Chart view"), ChartView::bindings()},
                             {tr("Numbers"), NumberField::bindings()}};
  return groups + menuBindings(*menuBar());
}

void MainWindow::setPictureMode(bool on) {
  statusLine_->setMemoryVisible(!on);
  session_.log().setTimeless(on);
  viewport_->setPictureMode(on);
}

bool MainWindow::bringToFront(const QString& name) {
  auto* dock = findChild<QDockWidget*>(name);
  if (!dock) return false;
  if (dock->isHidden()) layouts_->chooseFor(name);
  dock->show();
  dock->raise();
  return true;
}

QStringList MainWindow::dockNames() const {
  QStringList names;
  for (const QDockWidget* dock : docks_) names << dock->objectName();
  return names;
}

bool MainWindow::event(QEvent* event) {
  if (event->type() != QEvent::StatusTip) return QMainWindow::event(event);
  statusLine_->setTip(static_cast<QStatusTipEvent*>(event)->tip());
  return true;
}

void MainWindow::refreshTitle() {
  setWindowTitle(QStringLiteral("%1%2 \u2014 PRT Studio")
                     .arg(documentName(session_.document()),
                          session_.document().modified() ? QStringLiteral(" *") : QString()));
}

void MainWindow::offerRecovery() {
  recovery_->offer();
}

// The project is open with what it has; what it lacks is told where the picture is.
void MainWindow::showLinks() {
  QStringList missing, changed;
  for (const LinkedFile& link : session_.project().brokenLinks())
    (link.state == LinkState::Missing ? missing : changed)
        << QString::fromStdString(link.file.filename().string());
  QStringList lines;
  if (!missing.isEmpty())
    lines << tr("Missing: %1. The project is open with what it has.").arg(missing.join(QStringLiteral(", ")));
  if (!changed.isEmpty())
    lines << tr("Changed since the project was saved: %1. What was made from it is baked again.")
                 .arg(changed.join(QStringLiteral(", ")));
  if (lines.isEmpty()) return;
  session_.log().add(Severity::Warning, lines.join(u' '));
  message_->show(Severity::Warning, lines.join(u'\n'));
  if (!missing.isEmpty()) message_->offer(tr("Locate\u2026"), [this] { documents_->relink(); });
  placeMessage();
}

// Along the top of the picture, clear of what the corners say.
void MainWindow::placeMessage() {
  const int width = std::min(560, viewport_->width() - 48);
  setWidth(*message_, width);
  message_->move((viewport_->width() - width) / 2, viewport_->height() - message_->height() - 16);
  message_->raise();
  setWidth(*recovery_, std::min(kRecoveryWidth, viewport_->width() - 48));
  recovery_->move((viewport_->width() - recovery_->width()) / 2, kRecoveryTop);
  recovery_->raise();
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  placeMessage();
}

// Asks when something would be lost; false also while it is saved first, after which the window closes
// itself.
bool MainWindow::mayClose() {
  if (leaving_) return true;
  const auto inside = std::make_shared<bool>(true);
  session_.project().leaveThen([this, inside] {
    leaving_ = true;
    session_.project().giveUp();
    if (!*inside) close();
  });
  *inside = false;
  return leaving_;
}

void MainWindow::closeEvent(QCloseEvent* event) {
  if (!mayClose()) return event->ignore();
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
  layouts_->save(settings);
  event->accept();
}

}  // namespace prt::ui
