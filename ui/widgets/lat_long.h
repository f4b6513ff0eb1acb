#pragma once
// The sphere unrolled into a strip, as panoramas show it: straight up along the top edge, -Z in the middle,
// +X to the right of it; left and right edge are one meridian, +Z.

#include "libprt/core/math.h"

#include <QPainterPath>
#include <QPointF>
#include <QSizeF>

namespace prt::ui {

/// Where a unit direction is on a strip of this size; x from 0 to the width.
QPointF toStrip(const Vec3& direction, const QSizeF& size);
/// The reverse. x wraps around, y is kept on the strip.
Vec3 fromStrip(const QPointF& at, const QSizeF& size);

/// The disc of directions within `halfAngle` (radians, 0 .. pi) of a unit direction: the exact outline, which
/// is no circle on the strip, to a quarter of a pixel. What crosses an edge goes on at the other; what holds
/// a pole reaches along the whole edge. Cut to the strip.
QPainterPath discOnStrip(const Vec3& direction, double halfAngle, const QSizeF& size);
/// Its outline alone, for drawing: without the edges of the strip where the disc runs over them.
QPainterPath rimOnStrip(const Vec3& direction, double halfAngle, const QSizeF& size);

}  // namespace prt::ui
