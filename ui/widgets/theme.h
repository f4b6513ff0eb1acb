#pragma once
// The studio's look in one place: colours, fonts, spacing, icons. Widgets take everything from here.

#include <QColor>
#include <QIcon>
#include <QString>

class QApplication;
class QWidget;

namespace prt::ui {

struct Theme {
  QString name;
  // Surfaces, from back to front.
  QColor window, panel, field, fieldHover, line;
  QColor text, muted;
  QColor accent;    ///< what is live or selected
  QColor onAccent;  ///< text on it
  // States only: done, out of date, failed.
  QColor done, stale, failed;
};

/// Neutral grey without a tint, so that colours of the picture can be judged.
const Theme& darkTheme();
/// The theme in use.
const Theme& theme();

/// Sets palette, style sheet and font of the whole application.
void applyTheme(QApplication& application, const Theme& theme);

// The spacing grid is 4 pixels.
inline constexpr int kGrid = 4;
inline constexpr int kRowHeight = 24;
inline constexpr int kLabelWidth = 72;
inline constexpr int kResetWidth = 18;

/// What a widget is, for the style sheet: "muted", "heading", "done", "stale", "failed".
void setRole(QWidget* widget, const char* role);

/// A 16-pixel Breeze icon in the theme's text colour (muted where disabled), or in `color`.
QIcon icon(const QString& name, const QColor& color = {});

}  // namespace prt::ui
