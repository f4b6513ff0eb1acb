#pragma once
// The built-in icons (Breeze, 16 pixels, one colour), drawn when they are shown: sharp at any scale of the
// display and in the colours of the theme in use.

#include <QColor>
#include <QIcon>
#include <QString>

namespace prt::ui {

/// An icon in the theme's text colour, muted where disabled; or in `color`. A colour that belongs to the
/// theme follows it when another theme is chosen. Null when there is no such icon.
QIcon icon(const QString& name, const QColor& color = {});

/// The program's own icon.
QIcon applicationIcon();

}  // namespace prt::ui
