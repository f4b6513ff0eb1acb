#include "ui/window/chart_actions.h"

#include "ui/docks/chart_dock.h"
#include "ui/model/chart_editor.h"
#include "ui/model/session.h"
#include "ui/window/menu_action.h"

#include <QActionGroup>
#include <QMenu>

#include <functional>

namespace prt::ui {

namespace {

QString tr(const char* text) {
  return QObject::tr(text);
}

}  // namespace

void fillChartMenu(QMenu& menu, Session& session, ChartDock& dock, const std::function<void()>& show) {
  menu.setToolTipsVisible(true);
  ChartEditor& charts = session.charts();
  QAction* cut =
      addMenuAction(menu, "cutCharts", tr("&Draw cuts"),
                    tr("The knife: click on the model, each click cuts the shortest way from the last one."),
                    [&charts, show] {
                      if (!charts.cutting()) show();
                      charts.setCutting(!charts.cutting());
                    });
  cut->setCheckable(true);
  cut->setShortcut(QKeySequence(Qt::Key_K));
  QAction* creases = addMenuAction(menu, "followCreases", tr("Cuts follow &creases"),
                                   tr("The way between two clicks keeps to edges where the surface bends."),
                                   [&charts] { charts.setFollowCreases(!charts.followCreases()); });
  creases->setCheckable(true);
  QAction* automatic =
      addMenuAction(menu, "autoCut", tr("&Auto cut"),
                    tr("Few charts, each a disk, with seams where they are seen least."), [&charts, show] {
                      show();
                      charts.autoCut();
                    });
  QAction* mend =
      addMenuAction(menu, "mendCharts", tr("Cut as &suggested"), tr("Every chart is a disk then."),
                    [&charts] { charts.applyAllSuggestions(); });
  QAction* clear =
      addMenuAction(menu, "removeCuts", tr("&Remove all cuts"), tr("Takes all cuts of all objects away."),
                    [&charts] { charts.removeAllCuts(); });
  menu.addSeparator();
  QAction* flatten = addMenuAction(menu, "flattenCharts", tr("&Lay charts flat anew"),
                                   tr("Every chart from the beginning."), [&charts] { charts.flattenAll(); });
  QAction* pack = addMenuAction(menu, "packCharts", tr("&Pack charts"),
                                tr("Everything anew that is not locked."), [&charts] { charts.packAll(); });
  menu.addSeparator();
  QMenu* shown = menu.addMenu(tr("Sho&w on the surface"));
  auto* group = new QActionGroup(&menu);
  for (int i = 0; i <= int(ChartShade::Density); ++i) {
    QAction* action = shown->addAction(nameOf(ChartShade(i)), &charts, [&charts, show, i] {
      show();
      charts.setShade(ChartShade(i));
    });
    action->setCheckable(true);
    group->addAction(action);
  }
  menu.addSeparator();
  QAction* import = addMenuAction(menu, "importCoordinates", tr("&Import UVs"),
                                  tr("The meshes' own texture coordinates as the atlas."),
                                  [&charts] { charts.useImported(); });
  QAction* write = addMenuAction(menu, "exportCoordinates", tr("&Export UVs\u2026"),
                                 tr("The mesh with the atlas as its texture coordinates: OBJ, glTF or GLB."),
                                 [&dock] { dock.exportCoordinates(); });
  const auto follow = [&session, &charts, cut, creases, automatic, mend, clear, flatten, pack, group, import,
                       write] {
    const bool imported = session.document().recipe().charts.mode == ChartsMode::Imported;
    const bool some = !charts.items().empty();
    cut->setChecked(charts.cutting());
    creases->setChecked(charts.followCreases());
    automatic->setEnabled(charts.ready() && !charts.autoCutting());
    mend->setEnabled(charts.numbers().notDisks > 0);
    clear->setEnabled(charts.ready() && charts.seams().count() > 0);
    flatten->setEnabled(some && !imported);
    pack->setEnabled(some && !imported);
    group->actions()[int(charts.shade())]->setChecked(true);
    import->setEnabled(charts.hasCoordinates() && !imported);
    write->setEnabled(charts.atlas() != nullptr);
  };
  QObject::connect(&charts, &ChartEditor::changed, &menu, follow);
  QObject::connect(&charts, &ChartEditor::cutChanged, &menu, follow);
  follow();
}

}  // namespace prt::ui
