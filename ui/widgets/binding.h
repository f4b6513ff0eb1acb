#pragma once
// What a key or a movement of the mouse does at one place. The place itself lists its bindings; the overlay
// of keys shows them.

#include <QList>
#include <QString>

namespace prt::ui {

struct Binding {
  QString keys;  ///< "Shift + drag"; several ways with " or " between them
  QString what;  ///< "turns the environment"
};

struct BindingGroup {
  QString title;
  QList<Binding> bindings;
};

}  // namespace prt::ui
