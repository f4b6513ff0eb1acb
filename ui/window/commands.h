#pragma once
// What the command palette finds in a window: every action of the menus, every button and every row of the
// docks, and the recipe's parameters that have no row.

#include "ui/model/command_index.h"

class QMainWindow;
class QWidget;

namespace prt::ui {

class Session;

/// `ask` opens the palette with a line, for parameters that are set there.
std::vector<Command> collectCommands(QMainWindow& window, Session& session,
                                     const std::function<void(const QString& line)>& ask);

/// "transfer.bands = 6" as a command that sets it; while the value is not one, a disabled one that says why.
std::optional<Command> assignment(Session& session, const QString& line);

/// Brings a widget of a dock to light: dock in front, section open, scrolled to it, keyboard in it.
void reveal(QWidget* widget);

}  // namespace prt::ui
