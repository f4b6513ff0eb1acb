#pragma once
// The colour scale of the error overlay with its unit, and the floor in numbers: drawn over the picture.

#include <QSize>

class QPainter;

namespace prt::ui {

class Session;

/// Draws at the bottom right of a viewport of this size, in logical pixels; nothing while no error is shown.
void paintErrorLegend(QPainter& painter, const QSize& size, Session& session);

}  // namespace prt::ui
