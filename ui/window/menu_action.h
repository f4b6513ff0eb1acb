#pragma once
// An entry of a menu that is found by its name, and whose tip the status bar shows too.

#include <QAction>
#include <QMenu>

#include <functional>
#include <utility>

namespace prt::ui {

inline QAction* addMenuAction(QMenu& menu, const char* name, const QString& text, const QString& tip,
                              std::function<void()> run) {
  QAction* action = menu.addAction(text, &menu, [run = std::move(run)] { run(); });
  action->setObjectName(QLatin1String(name));
  action->setToolTip(tip);
  action->setStatusTip(tip);
  return action;
}

}  // namespace prt::ui
