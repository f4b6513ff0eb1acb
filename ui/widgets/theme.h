#pragma once
// The studio's look in one place: colours, fonts, spacing, icons. Widgets take everything from here.

#include "ui/widgets/icon.h"

#include <QColor>
#include <QString>

class QApplication;
class QWidget;

namespace prt::ui {

struct Theme {
  QString name;
  // Surfaces, from back to front.
  QColor window, panel, field, fieldHover, line;
  QColor text, muted;  ///< legible on all of them; a selected line of a list stands on `line`
  QColor accent;       ///< what is live or selected
  QColor onAccent;     ///< text on it
  // States only: done, out of date, failed.
  QColor done, stale, failed;
};

/// Neutral grey without a tint, so that colours of the picture can be judged.
const Theme& darkTheme();
/// The same the other way round.
const Theme& lightTheme();
/// "dark" or "light"; null for other names.
const Theme* themeNamed(const QString& name);
/// The theme in use.
const Theme& theme();
/// For what is written over pictures, which no theme makes brighter: dark whichever is in use.
inline const Theme& pictureTheme() {
  return darkTheme();
}
/// What such text stands on, so dense that it can be read on white.
inline QColor pictureVeil() {
  return {0x14, 0x14, 0x14, 220};
}

/// Which colour of the theme in use this is, null when it is none of them.
QColor Theme::*roleOf(const QColor& color);
/// `share` of b in a.
QColor mixed(const QColor& a, const QColor& b, double share);
/// Contrast of two colours as WCAG 2 defines it, 1 to 21. Text needs 4.5.
double contrast(const QColor& a, const QColor& b);

/// Sets palette, style sheet and font of the whole application; also while it runs.
void applyTheme(QApplication& application, const Theme& theme);

// The spacing grid is 4 pixels.
inline constexpr int kGrid = 4;
inline constexpr int kRowHeight = 24;
inline constexpr int kLabelWidth = 72;
inline constexpr int kResetWidth = 18;

/// What a widget is, for the style sheet: "muted", "heading", "done", "stale", "failed".
void setRole(QWidget* widget, const char* role);

}  // namespace prt::ui
