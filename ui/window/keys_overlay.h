#pragma once
// All keys and mouse movements at a glance, as the actions and the places themselves tell them.

#include "ui/widgets/binding.h"
#include "ui/window/sheet.h"

#include <functional>

class QAction;
class QMenuBar;

namespace prt::ui {

class KeysOverlay : public Sheet {
  Q_OBJECT
 public:
  /// `groups` is asked each time it opens, so that it shows what holds now.
  KeysOverlay(QWidget* window, std::function<QList<BindingGroup>()> groups);

 protected:
  QRect panelPlace(const QSize& window) const override;
  QWidget* aboutToOpen() override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void fill(const QList<BindingGroup>& groups);

  std::function<QList<BindingGroup>()> groups_;
  QWidget* content_ = nullptr;
};

/// An action's text without the marks of its mnemonic.
QString plainText(const QAction& action);

/// The actions of a menu bar that have a shortcut, menu by menu; submenus count as their menu.
QList<BindingGroup> menuBindings(const QMenuBar& menus);

}  // namespace prt::ui
