#include "ui/model/navigation.h"

#include <QCoreApplication>

#include <vector>

namespace prt::ui {

namespace {

struct Binding {
  NavigationPreset preset;
  Qt::MouseButton button;
  Qt::KeyboardModifiers modifiers;
  DragAction action;
};

constexpr Qt::KeyboardModifiers kCounted = Qt::ShiftModifier | Qt::ControlModifier | Qt::AltModifier;

const std::vector<Binding>& bindings() {
  using P = NavigationPreset;
  const Qt::KeyboardModifiers none = Qt::NoModifier, shift = Qt::ShiftModifier, control = Qt::ControlModifier,
                              alt = Qt::AltModifier;
  static const std::vector<Binding> all{
      {P::Blender, Qt::MiddleButton, none, DragAction::Orbit},
      {P::Blender, Qt::MiddleButton, shift, DragAction::Pan},
      {P::Blender, Qt::MiddleButton, control, DragAction::Zoom},
      {P::Blender, Qt::LeftButton, alt, DragAction::Orbit},
      {P::Blender, Qt::LeftButton, alt | shift, DragAction::Pan},
      {P::Blender, Qt::LeftButton, alt | control, DragAction::Zoom},
      {P::Maya, Qt::LeftButton, alt, DragAction::Orbit},
      {P::Maya, Qt::MiddleButton, alt, DragAction::Pan},
      {P::Maya, Qt::RightButton, alt, DragAction::Zoom},
      {P::Substance, Qt::LeftButton, alt, DragAction::Orbit},
      {P::Substance, Qt::MiddleButton, alt, DragAction::Pan},
      {P::Substance, Qt::LeftButton, alt | control, DragAction::Pan},
      {P::Substance, Qt::RightButton, alt, DragAction::Zoom},
  };
  return all;
}

QString text(const char* source) {
  return QCoreApplication::translate("Navigation", source);
}

QString dragName(const Binding& b) {
  QString keys;
  if (b.modifiers & Qt::ControlModifier) keys += text("Ctrl+");
  if (b.modifiers & Qt::AltModifier) keys += text("Alt+");
  if (b.modifiers & Qt::ShiftModifier) keys += text("Shift+");
  const QString button = b.button == Qt::LeftButton    ? text("left")
                         : b.button == Qt::RightButton ? text("right")
                                                       : text("middle");
  return keys + button;
}

QString actionName(DragAction action) {
  switch (action) {
    case DragAction::Orbit:
      return text("orbits");
    case DragAction::Pan:
      return text("pans");
    case DragAction::Zoom:
      return text("zooms");
    case DragAction::TurnLight:
      return text("turns the environment");
    case DragAction::None:
      break;
  }
  return {};
}

}  // namespace

DragAction dragAction(NavigationPreset preset, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
  const Qt::KeyboardModifiers held = modifiers & kCounted;
  if (held == Qt::ShiftModifier && (button == Qt::LeftButton || button == Qt::RightButton))
    return DragAction::TurnLight;
  for (const Binding& b : bindings())
    if (b.preset == preset && b.button == button && b.modifiers == held) return b.action;
  return DragAction::None;
}

QString navigationHint(NavigationPreset preset) {
  QStringList parts{text("Shift+drag turns the light")};
  DragAction last = DragAction::None;
  for (const Binding& b : bindings()) {
    if (b.preset != preset || b.action == last ||
        (preset == NavigationPreset::Blender && b.button == Qt::LeftButton))
      continue;
    last = b.action;
    parts << dragName(b) + u' ' + actionName(b.action);
  }
  parts << text("wheel zooms") << text("F frames") << text("R resets");
  return parts.join(QStringLiteral("   \u00b7   "));
}

QList<std::pair<QString, QString>> navigationKeys(NavigationPreset preset) {
  QList<std::pair<QString, QString>> keys{
      {text("Shift + left or right drag"), actionName(DragAction::TurnLight)}};
  for (const Binding& b : bindings())
    if (b.preset == preset) keys << std::pair(text("%1 drag").arg(dragName(b)), actionName(b.action));
  keys << std::pair(text("wheel"), text("zooms towards the pointer"))
       << std::pair(text("two fingers"), text("orbit; Shift pans, Ctrl or a pinch zooms"));
  return keys;
}

QList<NavigationPreset> navigationPresets() {
  return {NavigationPreset::Blender, NavigationPreset::Maya, NavigationPreset::Substance};
}

QString nameOf(NavigationPreset preset) {
  switch (preset) {
    case NavigationPreset::Blender:
      return QStringLiteral("Blender");
    case NavigationPreset::Maya:
      return QStringLiteral("Maya");
    case NavigationPreset::Substance:
      return QStringLiteral("Substance");
  }
  return {};
}

NavigationPreset navigationPreset(const QString& name) {
  for (const NavigationPreset preset : navigationPresets())
    if (nameOf(preset) == name) return preset;
  return NavigationPreset::Blender;
}

WheelMove wheelMove(bool fingers, double x, double y, Qt::KeyboardModifiers modifiers) {
  constexpr double kNotch = 120, kPixelsPerStep = 60;
  if (!fingers)
    return {.zoomSteps = (y != 0 ? y : x) / kNotch};  // with Alt some systems turn wheels sideways
  if (modifiers & Qt::ControlModifier) return {.zoomSteps = y / kPixelsPerStep};
  if (modifiers & Qt::ShiftModifier) return {.panX = x, .panY = y};
  return {.orbitX = x, .orbitY = y};
}

}  // namespace prt::ui
