#include "ui/main_window.h"

#include "ui/docks/jobs_dock.h"
#include "ui/docks/light_dock.h"
#include "ui/docks/log_dock.h"
#include "ui/docks/material_dock.h"
#include "ui/docks/scene_dock.h"
#include "ui/docks/transfer_dock.h"
#include "ui/document_menu.h"
#include "ui/model/error_estimate.h"
#include "ui/model/session.h"
#include "ui/viewport/light_handles.h"
#include "ui/viewport/view_actions.h"
#include "ui/viewport/viewport.h"
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

#include <QActionGroup>
#include <QApplication>
#include <QBuffer>
#include <QCloseEvent>
#include <QDockWidget>
#include <QLabel>
#include <QMenuBar>
#include <QPointer>
#include <QSettings>
#include <QStatusBar>
#include <QStatusTipEvent>
#include <QTimer>

#include <fstream>
#include <memory>

namespace prt::ui {

namespace {

constexpr int kLayoutVersion = 2;  // raised when the docks change, so that old layouts are not restored
constexpr int kRecoveryTop = 72;   // below what the corners of the picture say
constexpr int kRecoveryWidth = 640;
constexpr int kThumbWidth = 192, kThumbHeight = 120;
constexpr int kDefaultWidth = 1440, kDefaultHeight = 900;

QString residentMemory() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return QObject::tr("%1 MB").arg(resident * 4096 / 1'000'000);
}

QByteArray thumbnailOf(Viewport& viewport) {
  const QImage picture = viewport.canvas().grabPicture();
  if (picture.isNull()) return {};
  QByteArray png;
  QBuffer buffer(&png);
  picture.scaled(kThumbWidth, kThumbHeight, Qt::KeepAspectRatio, Qt::SmoothTransformation)
      .save(&buffer, "PNG");
  return png;
}

}  // namespace

MainWindow::MainWindow(Session& session, bool freshLayout)
    : session_(session),
      documents_(new DocumentMenu(session, *this)),
      viewport_(new Viewport(session)),
      viewActions_(new ViewActions(session, *viewport_, !freshLayout, this)),
      lightHandles_(
          new LightHandles(session.lights(), session.rays(), [&session] { return session.bounds(); })),
      message_(new MessageBar(viewport_)),
      recovery_(new RecoveryBar(session.project(), viewport_)),
      strip_(new WorkflowStrip),
      layouts_(new Layouts(*this, layoutPlans(), kLayoutVersion)),
      fileLabel_(new QLabel),
      sizeLabel_(new QLabel),
      memoryLabel_(new QLabel),
      hintLabel_(new QLabel) {
  setObjectName(QStringLiteral("studio"));
  setCentralWidget(viewport_);
  viewport_->addManipulator(lightHandles_);
  setDockOptions(AllowNestedDocks | AllowTabbedDocks | GroupedDragging);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  makeDocks();
  makeSheets();
  makeMenus();
  makeStatusBar();
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
                             {tr("Numbers"), NumberField::bindings()}};
  return groups + menuBindings(*menuBar());
}

void MainWindow::makeMenus() {
  documents_->fillFile(menuBar()->addMenu(tr("&File")));
  makeEditMenu();
  makeViewMenu();
  makeHelpMenu();
  menuBar()->setCornerWidget(strip_, Qt::TopRightCorner);
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
  documents_->fillHistory(menu);
}

void MainWindow::makeViewMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&View"));
  viewActions_->fillViewMenu(*menu);
  QAction* handles =
      menu->addAction(tr("&Light handles"), QKeySequence(Qt::Key_L), lightHandles_, &Manipulator::setEnabled);
  handles->setCheckable(true);
  handles->setChecked(lightHandles_->enabled());
  handles->setObjectName(QStringLiteral("lightHandles"));
  menu->addSeparator();
  menu->addAction(tr("Next &error overlay"), QKeySequence(Qt::Key_E), this,
                  [this] { session_.errors().cycle(); });
  menu->addSeparator();
  for (QDockWidget* dock : docks_) menu->addAction(dock->toggleViewAction());
  menu->addSeparator();
  makeLayoutMenu(*menu);
  makeThemeMenu(*menu);
}

void MainWindow::makeLayoutMenu(QMenu& view) {
  QMenu* menu = view.addMenu(tr("&Layout"));
  auto* group = new QActionGroup(this);
  int key = Qt::Key_F5;
  for (const LayoutPlan& plan : layouts_->plans()) {
    QAction* action = menu->addAction(plan.title, QKeySequence(key++), this,
                                      [this, name = plan.name] { layouts_->choose(name); });
    action->setCheckable(true);
    action->setToolTip(plan.tip);
    action->setStatusTip(plan.tip);
    group->addAction(action);
    connect(layouts_, &Layouts::chosen, action,
            [action, name = plan.name](const QString& now) { action->setChecked(now == name); });
    strip_->addLayoutChoice(action);
  }
  menu->addSeparator();
  menu->addAction(icon(QStringLiteral("view-refresh")), tr("Reset window &layout"), this,
                  &MainWindow::resetLayout);
}

void MainWindow::makeThemeMenu(QMenu& view) {
  QMenu* menu = view.addMenu(tr("&Theme"));
  auto* group = new QActionGroup(this);
  for (const Theme* each : {&darkTheme(), &lightTheme()}) {
    QAction* action = menu->addAction(each == &darkTheme() ? tr("&Dark") : tr("&Light"), this, [each] {
      applyTheme(*qApp, *each);
      QSettings().setValue(QStringLiteral("theme"), each->name);
    });
    action->setCheckable(true);
    action->setChecked(theme().name == each->name);
    group->addAction(action);
  }
}

void MainWindow::makeHelpMenu() {
  QMenu* menu = menuBar()->addMenu(tr("&Help"));
  QAction* find =
      menu->addAction(icon(QStringLiteral("edit-find")), tr("&Find a command\u2026"), palette_, &Sheet::open);
  find->setShortcuts({QKeySequence(Qt::CTRL | Qt::Key_K), QKeySequence(Qt::Key_F3)});
  menu->addAction(icon(QStringLiteral("help-about")), tr("&Keys and mouse"), QKeySequence(Qt::Key_Question),
                  keys_, &Sheet::open);
}

void MainWindow::makeStatusBar() {
  statusBar()->setSizeGripEnabled(false);
  statusBar()->addWidget(fileLabel_);
  statusBar()->addWidget(sizeLabel_);
  statusBar()->addWidget(hintLabel_, 1);
  statusBar()->addPermanentWidget(memoryLabel_);
  sizeLabel_->setObjectName(QStringLiteral("sizeLabel"));
  sizeLabel_->setToolTip(
      tr("Size of the scene, width \u00d7 height \u00d7 depth. One unit of a file counts as one metre."));
  hintLabel_->setObjectName(QStringLiteral("hintLabel"));
  hintLabel_->setAlignment(Qt::AlignCenter);
  hintLabel_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  memoryLabel_->setObjectName(QStringLiteral("memoryLabel"));
  memoryLabel_->setToolTip(tr("Memory that the studio uses."));
  connect(viewport_, &Viewport::hintChanged, this, &MainWindow::refreshHint);
  connect(&session_.relighter(), &Relighter::sceneChanged, this, &MainWindow::refreshSize);
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, [this] { memoryLabel_->setText(residentMemory()); });
  timer->start(1000);
  memoryLabel_->setText(residentMemory());
  refreshHint();
}

// What the mouse does where it is: a widget's status tip, else the viewport's.
void MainWindow::refreshHint() {
  hintLabel_->setText(tip_.isEmpty() ? viewport_->hint() : tip_);
}

void MainWindow::refreshSize() {
  const Box3 box = session_.bounds();
  const Vec3 size = box.high - box.low;
  const bool any = session_.relighter().scene() && size.x >= 0;
  const auto text = [](float v) { return QString::number(double(v), 'g', 3); };
  sizeLabel_->setText(any ? tr("%1 \u00d7 %2 \u00d7 %3 m").arg(text(size.x), text(size.y), text(size.z))
                          : QString());
}

void MainWindow::setPictureMode(bool on) {
  memoryLabel_->setVisible(!on);
  session_.log().setTimeless(on);
  viewport_->setPictureMode(on);
}

bool MainWindow::bringToFront(const QString& name) {
  auto* dock = findChild<QDockWidget*>(name);
  if (!dock) return false;
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
  tip_ = static_cast<QStatusTipEvent*>(event)->tip();
  refreshHint();
  return true;
}

void MainWindow::refreshTitle() {
  const Document& document = session_.document();
  const QString name = document.title().isEmpty() ? tr("Untitled") : document.title();
  setWindowTitle(QStringLiteral("%1%2 \u2014 PRT Studio")
                     .arg(name, document.modified() ? QStringLiteral(" *") : QString()));
  fileLabel_->setText(name + (document.modified() ? tr(" \u00b7 edited") : QString()));
  fileLabel_->setToolTip(document.path());
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
  message_->setFixedWidth(width);
  message_->adjustSize();
  message_->move((viewport_->width() - width) / 2, viewport_->height() - message_->height() - 16);
  message_->raise();
  recovery_->setFixedWidth(std::min(kRecoveryWidth, viewport_->width() - 48));
  recovery_->adjustSize();
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
