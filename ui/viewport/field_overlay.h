#pragma once
// What is drawn over the picture of an orientation field's lines: the strokes that it follows, and dots where
// it winds, with their index.

#include "ui/viewport/view_geometry.h"

#include <vector>

class QColor;
class QPainter;

namespace prt::ui {

class SceneRays;
class Session;

/// A line on the surface with arrows along it, faint where the model hides it.
void paintStroke(QPainter& painter, const ViewGeometry& view, const SceneRays& rays,
                 const std::vector<Vec3>& points, const QColor& color);
/// Strokes and dots, while the field is shown.
void paintField(QPainter& painter, const ViewGeometry& view, Session& session);
/// Whether the model hides a point of its surface.
bool hiddenBySurface(const Vec3& point, const ViewGeometry& view, const SceneRays& rays);

}  // namespace prt::ui
