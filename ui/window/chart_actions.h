#pragma once
// What can be done to charts, as a menu: the same that the dock does, found by name, with keys.

#include <QObject>

#include <functional>

class QMenu;

namespace prt::ui {

class ChartDock;
class Session;

/// Fills the Charts menu; check marks and what is possible follow the editor. `show` brings the dock to
/// light.
void fillChartMenu(QMenu& menu, Session& session, ChartDock& dock, const std::function<void()>& show);

}  // namespace prt::ui
