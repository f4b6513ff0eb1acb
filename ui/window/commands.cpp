#include "ui/window/commands.h"

#include "libprt/core/error.h"
#include "ui/model/session.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/section.h"
#include "ui/window/keys_overlay.h"

#include <nlohmann/json.hpp>

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>

#include <set>

namespace prt::ui {

namespace {

const QString kInside = QStringLiteral(" \u203a ");

void collectMenu(const QMenu& menu, const QString& group, std::vector<Command>& commands) {
  for (QAction* action : menu.actions()) {
    if (action->isSeparator() || !action->isVisible()) continue;
    const QString title = plainText(*action);
    if (action->menu()) {
      collectMenu(*action->menu(), group + kInside + title, commands);
      continue;
    }
    Command command;
    command.id = QStringLiteral("menu/") + group + u'/' + title;
    command.title = title;
    command.group = group;
    command.shortcut = action->shortcut().toString(QKeySequence::NativeText);
    command.detail =
        action->isCheckable() ? (action->isChecked() ? QObject::tr("on") : QObject::tr("off")) : QString();
    command.tip = action->toolTip();
    command.enabled = action->isEnabled();
    command.run = [action = QPointer<QAction>(action)] {
      if (action) action->trigger();
    };
    commands.push_back(std::move(command));
  }
}

QString shownValue(const QWidget* field) {
  if (const auto* number = qobject_cast<const NumberField*>(field))
    return number->text() + u' ' + number->format().unit;
  if (const auto* box = qobject_cast<const QComboBox*>(field)) return box->currentText();
  if (const auto* line = qobject_cast<const QLineEdit*>(field)) return line->text();
  if (const auto* check = qobject_cast<const QCheckBox*>(field))
    return check->isChecked() ? QObject::tr("on") : QObject::tr("off");
  return {};
}

QString sectionOf(const QWidget* widget, const QString& dock) {
  for (const QWidget* at = widget; at; at = at->parentWidget())
    if (const auto* section = qobject_cast<const Section*>(at))
      return section->title() == dock ? dock : dock + kInside + section->title();
  return dock;
}

// Whether its dock took it away: a row, or its whole section, that nothing reads now. (In a closed section it
// is only folded away.)
bool takenAway(const PropertyRow& row) {
  if (row.isHidden()) return true;
  for (const QWidget* at = &row; at; at = at->parentWidget())
    if (const auto* section = qobject_cast<const Section*>(at)) return section->isHidden();
  return false;
}

// Rows: labels that belong to a field. What a dock has taken away is left to be set by its path.
void collectRows(const QDockWidget& dock, std::vector<Command>& commands, std::set<QString>& paths) {
  for (const QLabel* label : dock.findChildren<QLabel*>()) {
    QWidget* field = label->buddy();
    if (!field || !field->isEnabled()) continue;
    const auto* row = qobject_cast<PropertyRow*>(label->parentWidget());
    if (row && takenAway(*row)) continue;
    Command command;
    command.title = label->text();
    command.group = sectionOf(label, dock.windowTitle());
    command.id = QStringLiteral("row/") + command.group + u'/' + command.title;
    command.detail = shownValue(field).trimmed();
    command.tip = label->toolTip();
    if (row) {
      paths.insert(row->path());
      command.id = QStringLiteral("row/") + row->path();
      if (command.detail.isEmpty()) command.detail = row->valueText();
      command.tip = QString::fromStdString(parameterAt(row->path().toStdString()).doc);
    }
    command.run = [field = QPointer<QWidget>(field)] {
      if (field) reveal(field);
    };
    commands.push_back(std::move(command));
  }
}

void collectButtons(const QDockWidget& dock, std::vector<Command>& commands) {
  for (QAbstractButton* button : dock.findChildren<QAbstractButton*>()) {
    const bool check = qobject_cast<QCheckBox*>(button);
    if ((!qobject_cast<QPushButton*>(button) && !check) || button->text().isEmpty() || button->isHidden())
      continue;
    Command command;
    command.title = button->text().remove(u'&');
    command.group = sectionOf(button, dock.windowTitle());
    command.id = QStringLiteral("button/") + command.group + u'/' + command.title;
    command.detail = check ? (button->isChecked() ? QObject::tr("on") : QObject::tr("off")) : QString();
    command.tip = button->toolTip();
    command.enabled = button->isEnabled();
    command.run = [button = QPointer<QAbstractButton>(button)] {
      if (button) button->click();
    };
    commands.push_back(std::move(command));
  }
}

// "objects[0].material.specular" as its row would have it: short where the first object is meant.
bool hasRow(const std::set<QString>& paths, const QString& path) {
  if (paths.count(path)) return true;
  const QString first = QStringLiteral("objects[0].");
  return path.startsWith(first) && paths.count(path.mid(first.size()));
}

void collectParameters(Session& session, const std::set<QString>& rows,
                       const std::function<void(const QString&)>& ask, std::vector<Command>& commands) {
  const Recipe& recipe = session.document().recipe();
  for (const std::string& name : pathsOf(recipe)) {
    const QString path = QString::fromStdString(name);
    if (hasRow(rows, path)) continue;
    Command command;
    command.id = QStringLiteral("set/") + path;
    command.title = parameterTitle(path);
    command.group = path;
    command.detail = QString::fromStdString(getByPath(recipe, name).dump());
    command.tip = QString::fromStdString(parameterAt(name).doc);
    command.run = [ask, line = path + QStringLiteral(" = ") + command.detail] { ask(line); };
    commands.push_back(std::move(command));
  }
}

}  // namespace

std::vector<Command> collectCommands(QMainWindow& window, Session& session,
                                     const std::function<void(const QString&)>& ask) {
  std::vector<Command> commands;
  for (const QAction* action : window.menuBar()->actions())
    if (action->menu()) collectMenu(*action->menu(), plainText(*action), commands);
  std::set<QString> paths;
  for (const QDockWidget* dock : window.findChildren<QDockWidget*>()) {
    collectButtons(*dock, commands);
    collectRows(*dock, commands, paths);
  }
  collectParameters(session, paths, ask, commands);
  return commands;
}

std::optional<Command> assignment(Session& session, const QString& line) {
  const qsizetype equals = line.indexOf(u'=');
  if (equals < 0) return {};
  const QString path = line.left(equals).trimmed(), value = line.mid(equals + 1).trimmed();
  Command command;
  command.group = QObject::tr("Recipe");
  command.id = QStringLiteral("set/") + path;
  command.title = QObject::tr("Set %1 to %2").arg(path, value);
  try {
    command.tip = QString::fromStdString(parameterAt(path.toStdString()).doc);
    Recipe trial = session.document().recipe();
    setByPath(trial, path.toStdString(), value.toStdString());
    checkRecipe(trial, "recipe");
    command.run = [&session, path, value] {
      try {
        session.document().set(path, value);
      } catch (const Error& error) {
        session.report(Severity::Error, QString::fromUtf8(error.what()));
      }
    };
  } catch (const std::exception& error) {
    command.title = QString::fromUtf8(error.what());
    command.group.clear();
    command.enabled = false;
  }
  return command;
}

void reveal(QWidget* widget) {
  QScrollArea* scroll = nullptr;
  for (QWidget* at = widget; at; at = at->parentWidget()) {
    if (auto* section = qobject_cast<Section*>(at)) section->setOpen(true);
    if (auto* area = qobject_cast<QScrollArea*>(at)) scroll = area;
    auto* dock = qobject_cast<QDockWidget*>(at);
    if (!dock) continue;
    dock->show();
    dock->raise();
    break;
  }
  if (scroll) scroll->ensureWidgetVisible(widget);
  widget->setFocus(Qt::ShortcutFocusReason);
}

}  // namespace prt::ui
