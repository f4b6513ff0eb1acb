#include "ui/main_window.h"

#include "ui/docks/jobs_dock.h"
#include "ui/docks/light_dock.h"
#include "ui/docks/log_dock.h"
#include "ui/docks/material_dock.h"
#include "ui/docks/scene_dock.h"
#include "ui/docks/transfer_dock.h"
#include "ui/model/session.h"
#include "ui/viewport/light_handles.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/dock_title.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/workflow_strip.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QMenuBar>
#include <QMessageBox>
#include <QSettings>
#include <QStatusBar>
#include <QTimer>

#include <fstream>

namespace prt::ui {

namespace {

constexpr int kLayoutVersion = 1;  // raised when the docks change, so that old layouts are not restored
constexpr int kLeftWidth = 232, kRightWidth = 264;
constexpr int kDefaultWidth = 1440, kDefaultHeight = 900;

QString residentMemory() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return QObject::tr("%1 MB").arg(resident * 4096 / 1'000'000);
}

}  // namespace

MainWindow::MainWindow(Session& session, bool freshLayout)
    : session_(session),
      viewport_(new Viewport(session)),
      lightHandles_(new LightHandles(session.lights(), session.rays(), [&session] { return session.bounds(); })),
      message_(new MessageBar(viewport_)),
      strip_(new WorkflowStrip),
      fileLabel_(new QLabel),
      memoryLabel_(new QLabel),
      hintLabel_(new QLabel) {
  setObjectName(QStringLiteral("studio"));
  setCentralWidget(viewport_);
  viewport_->addManipulator(lightHandles_);
  setDockOptions(AllowNestedDocks | AllowTabbedDocks | GroupedDragging);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  makeDocks();
  makeMenus();
  makeStatusBar();
  resize(kDefaultWidth, kDefaultHeight);
  resetLayout();
  firstLayout_ = saveState(kLayoutVersion);
  QSettings settings;
  if (freshLayout) {
    settings.remove(QStringLiteral("window"));
  } else {
    restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
    restoreState(settings.value(QStringLiteral("window/layout")).toByteArray(), kLayoutVersion);
  }

  connect(&session_, &Session::message, this, [this](Severity severity, const QString& text, Place place) {
    if (place != Place::Viewport) return;
    message_->show(severity, text);
    placeMessage();
  });
  connect(&session_.document(), &Document::opened, message_, &QWidget::hide);
  connect(&session_.document(), &Document::stateChanged, this, &MainWindow::refreshTitle);
  connect(&session_, &Session::statusChanged, strip_, &WorkflowStrip::refresh);
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
  const auto fold = [this, dock, bar] { bar->setFolded(!dock->isFloating() && !tabifiedDockWidgets(dock).isEmpty()); };
  connect(dock, &QDockWidget::visibilityChanged, this, fold);
  connect(dock, &QDockWidget::dockLocationChanged, this, fold);
  connect(dock, &QDockWidget::topLevelChanged, this, fold);
  addDockWidget(area, dock);
  docks_ << dock;
  return dock;
}

void MainWindow::makeDocks() {
  QDockWidget* scene = addDock(tr("Scene"), QStringLiteral("scene"), new SceneDock(session_), Qt::LeftDockWidgetArea);
  QDockWidget* light = addDock(tr("Light"), QStringLiteral("light"), new LightDock(session_), Qt::LeftDockWidgetArea);
  addDock(tr("Jobs"), QStringLiteral("jobs"), new JobsDock(session_.jobs()), Qt::LeftDockWidgetArea);
  addDock(tr("Log"), QStringLiteral("log"), new LogDock(session_.log()), Qt::LeftDockWidgetArea);
  addDock(tr("Material"), QStringLiteral("material"), new MaterialDock(session_), Qt::RightDockWidgetArea);
  QDockWidget* transfer =
      addDock(tr("Transfer"), QStringLiteral("transfer"), new TransferDock(session_), Qt::RightDockWidgetArea);

  const auto bring = [](QDockWidget* dock) {
    return [dock] {
      dock->show();
      dock->raise();
    };
  };
  const auto stage = [this](std::initializer_list<const char*> names) {
    QStringList list;
    for (const char* name : names) list << QString::fromLatin1(name);
    return [this, list] { return session_.bakes().worstStatus(list); };
  };
  strip_->addStep(tr("Mesh"), tr("The objects, read and repaired."), stage({"mesh"}), bring(scene));
  strip_->addStep(tr("Transfer"), tr("What is baked for the surface."), stage({"direct", "transfer"}), bring(transfer));
  strip_->addStep(tr("Light"), tr("The environment that shines on it."),
                  [this] { return session_.relighter().environment() ? ProductStatus::Fresh : ProductStatus::Missing; },
                  bring(light));
}

void MainWindow::resetLayout() {
  enum { kScene, kLight, kJobs, kLog, kMaterial, kTransfer };
  for (QDockWidget* each : docks_) {
    each->setFloating(false);
    each->show();
  }
  for (const int left : {kScene, kLight, kJobs, kLog}) addDockWidget(Qt::LeftDockWidgetArea, docks_[left]);
  for (const int right : {kMaterial, kTransfer}) addDockWidget(Qt::RightDockWidgetArea, docks_[right]);
  tabifyDockWidget(docks_[kJobs], docks_[kLog]);
  docks_[kJobs]->raise();
  resizeDocks({docks_[kScene], docks_[kMaterial]}, {kLeftWidth, kRightWidth}, Qt::Horizontal);
  resizeDocks({docks_[kScene], docks_[kLight], docks_[kJobs]}, {180, 468, 200}, Qt::Vertical);
  resizeDocks({docks_[kMaterial], docks_[kTransfer]}, {500, 348}, Qt::Vertical);
}

void MainWindow::makeMenus() {
  makeFileMenu();
  makeEditMenu();
  makeViewMenu();
  makeHelpMenu();
  menuBar()->setCornerWidget(strip_, Qt::TopRightCorner);
}

void MainWindow::makeFileMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&File"));
  menu->addAction(icon(QStringLiteral("document-open")), tr("&Open\u2026"), QKeySequence::Open, this, &MainWindow::openFile);
  QMenu* samples = menu->addMenu(tr("S&amples"));
  for (const QString& name : session_.sampleScenes())
    samples->addAction(name, this, [this, name] { session_.open(QStringLiteral("scene:") + name); });
  menu->addSeparator();
  menu->addAction(icon(QStringLiteral("document-save")), tr("&Save project"), QKeySequence::Save, this,
                  [this] { saveProject(false); });
  menu->addAction(icon(QStringLiteral("document-save-as")), tr("Save project &as\u2026"), QKeySequence::SaveAs, this,
                  [this] { saveProject(true); });
  menu->addSeparator();
  menu->addAction(icon(QStringLiteral("application-exit")), tr("&Quit"), QKeySequence::Quit, this, &QWidget::close);
}

void MainWindow::makeEditMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&Edit"));
  QAction* undo = menu->addAction(icon(QStringLiteral("edit-undo")), tr("&Undo"), QKeySequence::Undo,
                                  &session_.document(), &Document::undo);
  QAction* redo = menu->addAction(icon(QStringLiteral("edit-redo")), tr("&Redo"), QKeySequence::Redo,
                                  &session_.document(), &Document::redo);
  const auto refresh = [this, undo, redo] {
    const Document& document = session_.document();
    undo->setEnabled(document.canUndo());
    redo->setEnabled(document.canRedo());
    undo->setText(document.canUndo() ? tr("&Undo %1").arg(document.undoName()) : tr("&Undo"));
    redo->setText(document.canRedo() ? tr("&Redo %1").arg(document.redoName()) : tr("&Redo"));
  };
  connect(&session_.document(), &Document::stateChanged, this, refresh);
  refresh();
}

void MainWindow::makeViewMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&View"));
  menu->addAction(icon(QStringLiteral("zoom-fit-best")), tr("&Frame all"), QKeySequence(Qt::Key_F), this,
                  [this] { session_.frameAll(); });
  menu->addAction(icon(QStringLiteral("go-home")), tr("&Reset view"), QKeySequence(Qt::Key_R), this,
                  [this] { session_.view().reset(); });
  QAction* handles = menu->addAction(tr("&Light handles"), QKeySequence(Qt::Key_L), lightHandles_, &Manipulator::setEnabled);
  handles->setCheckable(true);
  handles->setChecked(lightHandles_->enabled());
  handles->setObjectName(QStringLiteral("lightHandles"));
  menu->addSeparator();
  for (QDockWidget* dock : docks_) menu->addAction(dock->toggleViewAction());
  menu->addSeparator();
  menu->addAction(icon(QStringLiteral("view-refresh")), tr("Reset window &layout"), this, &MainWindow::resetLayout);
}

void MainWindow::makeHelpMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&Help"));
  menu->addAction(icon(QStringLiteral("help-about")), tr("&Keys and mouse"), QKeySequence(Qt::Key_Question), this,
                  &MainWindow::showKeys);
}

void MainWindow::makeStatusBar() {
  statusBar()->setSizeGripEnabled(false);
  statusBar()->addWidget(fileLabel_);
  statusBar()->addWidget(hintLabel_, 1);
  statusBar()->addPermanentWidget(memoryLabel_);
  hintLabel_->setAlignment(Qt::AlignCenter);
  hintLabel_->setText(viewport_->hint());
  hintLabel_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  memoryLabel_->setToolTip(tr("Memory that the studio uses."));
  connect(viewport_, &Viewport::hintChanged, hintLabel_, &QLabel::setText);
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] { memoryLabel_->setText(residentMemory()); });
  timer->start(1000);
  memoryLabel_->setText(residentMemory());
}

void MainWindow::openFile() {
  const QString file = QFileDialog::getOpenFileName(
      this, tr("Open"), {},
      tr("Everything (*.prt *.json *.obj *.ply *.off *.stl *.gltf *.glb *.hdr *.exr *.png);;Projects (*.prt);;"
         "Meshes (*.obj *.ply *.off *.stl *.gltf *.glb);;Environments (*.hdr *.exr *.png);;All files (*)"));
  if (!file.isEmpty()) session_.open(file);
}

void MainWindow::saveProject(bool askForName) {
  QString file = session_.document().path();
  if (askForName || file.isEmpty())
    file = QFileDialog::getSaveFileName(this, tr("Save project"), file, tr("Projects (*.prt)"));
  if (file.isEmpty()) return;
  if (!file.endsWith(u".prt")) file += QStringLiteral(".prt");
  session_.save(file);
}

void MainWindow::refreshTitle() {
  const Document& document = session_.document();
  const QString name = document.title().isEmpty() ? tr("Untitled") : document.title();
  setWindowTitle(QStringLiteral("%1%2 \u2014 PRT Studio").arg(name, document.modified() ? QStringLiteral(" *") : QString()));
  fileLabel_->setText(name + (document.modified() ? tr(" \u00b7 edited") : QString()));
  fileLabel_->setToolTip(document.path());
}

// Along the top of the picture, clear of what the corners say.
void MainWindow::placeMessage() {
  const int width = std::min(560, viewport_->width() - 48);
  message_->setFixedWidth(width);
  message_->adjustSize();
  message_->move((viewport_->width() - width) / 2, viewport_->height() - message_->height() - 16);
  message_->raise();
}

void MainWindow::showKeys() {
  QMessageBox box(this);
  box.setWindowTitle(tr("Keys and mouse"));
  box.setText(tr(
      "<table cellspacing='6'>"
      "<tr><td><b>Shift + drag</b></td><td>turn the environment (either button)</td></tr>"
      "<tr><td><b>Alt + left drag</b>, <b>middle drag</b></td><td>orbit</td></tr>"
      "<tr><td>the same with <b>Shift</b></td><td>pan</td></tr>"
      "<tr><td><b>Wheel</b></td><td>zoom towards the pointer</td></tr>"
      "<tr><td><b>F</b>, <b>R</b></td><td>frame all, reset the view</td></tr>"
      "<tr><td><b>Drag a light, its rim</b></td><td>move it around the model, resize it; <b>L</b> hides the handles</td></tr>"
      "<tr><td><b>Ctrl+Z</b>, <b>Ctrl+Shift+Z</b></td><td>undo, redo</td></tr>"
      "<tr><td><b>Drag a number</b></td><td>scrub; Shift fine, Ctrl coarse; double click resets</td></tr>"
      "<tr><td><b>Drop a file</b></td><td>mesh, project, HDR</td></tr></table>"));
  box.exec();
}

void MainWindow::resizeEvent(QResizeEvent* event) {
  QMainWindow::resizeEvent(event);
  if (message_->isVisible()) placeMessage();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), saveGeometry());
  settings.setValue(QStringLiteral("window/layout"), saveState(kLayoutVersion));
  event->accept();
}

}  // namespace prt::ui
