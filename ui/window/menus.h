#pragma once
// The menus of the window apart from File: Edit, View with docks, layouts and themes, Help.

#include <QList>
#include <QObject>

class QDockWidget;
class QMainWindow;
class QMenu;

namespace prt::ui {

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
  Layouts& layouts;
  WorkflowStrip& strip;  ///< gets the layouts as buttons, too
  CommandPalette& palette;
  KeysOverlay& keys;
  QList<QDockWidget*> docks;
};

/// Fills the window's menu bar, File first.
void makeMenus(QMainWindow& window, const MenuTargets& targets);

}  // namespace prt::ui
