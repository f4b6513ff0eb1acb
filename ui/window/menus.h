#pragma once
// The menus of the window apart from File: Edit, View with docks, layouts and themes, Help.

#include <QList>
#include <QObject>

#include <functional>

class QDockWidget;
class QMainWindow;
class QMenu;

namespace prt::ui {

class ChartDock;
class CommandPalette;
class DocumentMenu;
class KeysOverlay;
class Layouts;
class LightHandles;
class Session;
class ViewActions;
class WorkflowStrip;

/// What the menus act on.
struct MenuTargets {
  Session& session;
  DocumentMenu& documents;
  ViewActions& view;
  LightHandles& lightHandles;
  ChartDock& charts;
  std::function<void()> showCharts;     ///< brings their dock to light
  std::function<void()> showSynthesis;  ///< and that of synthesis
  Layouts& layouts;
  WorkflowStrip& strip;  ///< gets the layouts as buttons, too
  CommandPalette& palette;
  KeysOverlay& keys;
  QList<QDockWidget*> docks;
};

/// Fills the window's menu bar, File first.
void makeMenus(QMainWindow& window, const MenuTargets& targets);

}  // namespace prt::ui
