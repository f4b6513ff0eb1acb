#pragma once
// Which drags move the camera: the habits of three programs, as a table that knows no widget. The mouse, the
// hint in the status bar and the page of keys all read it.

#include <QString>
#include <QStringList>

#include <utility>

namespace prt::ui {

enum class NavigationPreset { Blender, Maya, Substance };

enum class DragAction { None, Orbit, Pan, Zoom, TurnLight };

/// What a drag that begins with this button does. Shift with left or right turns the environment in every
/// preset.
DragAction dragAction(NavigationPreset preset, Qt::MouseButton button, Qt::KeyboardModifiers modifiers);

/// One line for the status bar while nothing is dragged.
QString navigationHint(NavigationPreset preset);
/// What the mouse does, for people: {drag, what it does}.
QList<std::pair<QString, QString>> navigationKeys(NavigationPreset preset);

/// All presets, in menu order, and their names; names are what the settings keep.
QList<NavigationPreset> navigationPresets();
QString nameOf(NavigationPreset preset);
/// The preset of a name; Blender when there is none.
NavigationPreset navigationPreset(const QString& name);

/// What a turn of the wheel or two fingers on a trackpad do.
struct WheelMove {
  double zoomSteps = 0;       ///< > 0: nearer
  double panX = 0, panY = 0;  ///< logical pixels that the scene follows
  double orbitX = 0, orbitY = 0;
};
/// `x`, `y`: of a wheel, eighths of a degree; of two fingers, pixels. Fingers orbit, with Shift they pan,
/// with Ctrl (a pinch is sent so) they zoom; a wheel always zooms.
WheelMove wheelMove(bool fingers, double x, double y, Qt::KeyboardModifiers modifiers);

}  // namespace prt::ui
