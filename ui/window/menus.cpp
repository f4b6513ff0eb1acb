#include "ui/window/menus.h"

#include "ui/document_menu.h"
#include "ui/model/error_estimate.h"
#include "ui/model/session.h"
#include "ui/viewport/light_handles.h"
#include "ui/viewport/view_actions.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/workflow_strip.h"
#include "ui/window/chart_actions.h"
#include "ui/window/command_palette.h"
#include "ui/window/keys_overlay.h"
#include "ui/window/layouts.h"
#include "ui/window/synthesis_actions.h"

#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QMenuBar>
#include <QSettings>

namespace prt::ui {

namespace {

QString tr(const char* text) {
  return QObject::tr(text);
}

void fillEdit(QMenu& menu, const MenuTargets& t) {
  Document& document = t.session.document();
  QAction* undo = menu.addAction(icon(QStringLiteral("edit-undo")), tr("&Undo"), QKeySequence::Undo,
                                 &document, &Document::undo);
  QAction* redo = menu.addAction(icon(QStringLiteral("edit-redo")), tr("&Redo"), QKeySequence::Redo,
                                 &document, &Document::redo);
  const auto refresh = [&document, undo, redo] {
    undo->setEnabled(document.canUndo());
    redo->setEnabled(document.canRedo());
    undo->setText(document.canUndo() ? tr("&Undo %1").arg(document.undoName()) : tr("&Undo"));
    redo->setText(document.canRedo() ? tr("&Redo %1").arg(document.redoName()) : tr("&Redo"));
  };
  QObject::connect(&document, &Document::stateChanged, &menu, refresh);
  refresh();
  t.documents.fillHistory(&menu);
}

void fillLayouts(QMenu& menu, const MenuTargets& t) {
  auto* group = new QActionGroup(&menu);
  int key = Qt::Key_F5;
  for (const LayoutPlan& plan : t.layouts.plans()) {
    QAction* action = menu.addAction(plan.title, QKeySequence(key++), &t.layouts,
                                     [&layouts = t.layouts, name = plan.name] { layouts.choose(name); });
    action->setCheckable(true);
    action->setToolTip(plan.tip);
    action->setStatusTip(plan.tip);
    group->addAction(action);
    QObject::connect(&t.layouts, &Layouts::chosen, action,
                     [action, name = plan.name](const QString& now) { action->setChecked(now == name); });
    t.strip.addLayoutChoice(action);
  }
  menu.addSeparator();
  menu.addAction(icon(QStringLiteral("view-refresh")), tr("Reset window &layout"), &t.layouts,
                 &Layouts::reset);
}

void fillThemes(QMenu& menu) {
  auto* group = new QActionGroup(&menu);
  for (const Theme* each : {&darkTheme(), &lightTheme()}) {
    QAction* action = menu.addAction(each == &darkTheme() ? tr("&Dark") : tr("&Light"), &menu, [each] {
      applyTheme(*qApp, *each);
      QSettings().setValue(QStringLiteral("theme"), each->name);
    });
    action->setCheckable(true);
    action->setChecked(theme().name == each->name);
    group->addAction(action);
  }
}

void fillView(QMenu& menu, const MenuTargets& t) {
  t.view.fillViewMenu(menu);
  QAction* handles = menu.addAction(tr("&Light handles"), QKeySequence(Qt::Key_L), &t.lightHandles,
                                    &Manipulator::setEnabled);
  handles->setCheckable(true);
  handles->setChecked(t.lightHandles.enabled());
  handles->setObjectName(QStringLiteral("lightHandles"));
  menu.addSeparator();
  menu.addAction(tr("Next &error overlay"), QKeySequence(Qt::Key_E), &t.session,
                 [&session = t.session] { session.errors().cycle(); });
  menu.addSeparator();
  for (QDockWidget* dock : t.docks) menu.addAction(dock->toggleViewAction());
  menu.addSeparator();
  fillLayouts(*menu.addMenu(tr("&Layout")), t);
  fillThemes(*menu.addMenu(tr("&Theme")));
}

void fillHelp(QMenu& menu, const MenuTargets& t) {
  QAction* find = menu.addAction(icon(QStringLiteral("edit-find")), tr("&Find a command\u2026"), &t.palette,
                                 &Sheet::open);
  find->setShortcuts({QKeySequence(Qt::CTRL | Qt::Key_K), QKeySequence(Qt::Key_F3)});
  menu.addAction(icon(QStringLiteral("help-about")), tr("&Keys and mouse"), QKeySequence(Qt::Key_Question),
                 &t.keys, &Sheet::open);
}

}  // namespace

void makeMenus(QMainWindow& window, const MenuTargets& targets) {
  QMenuBar& bar = *window.menuBar();
  targets.documents.fillFile(bar.addMenu(tr("&File")));
  fillEdit(*bar.addMenu(tr("&Edit")), targets);
  fillView(*bar.addMenu(tr("&View")), targets);
  fillChartMenu(*bar.addMenu(tr("&Charts")), targets.session, targets.charts, targets.showCharts);
  fillSynthesisMenu(*bar.addMenu(tr("&Synthesis")), targets.session, targets.showSynthesis);
  fillHelp(*bar.addMenu(tr("&Help")), targets);
  bar.setCornerWidget(&targets.strip, Qt::TopRightCorner);
}

}  // namespace prt::ui
