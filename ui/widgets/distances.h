#pragma once
// Distances between places on the screen, in logical pixels.

#include <QPointF>

#include <algorithm>
#include <cmath>

namespace prt::ui {

inline double distance(const QPointF& a, const QPointF& b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

/// To the nearest place of a line's piece from a to b.
inline double distanceToPiece(const QPointF& p, const QPointF& a, const QPointF& b) {
  const QPointF along = b - a;
  const double square = QPointF::dotProduct(along, along);
  const double t = square > 0 ? std::clamp(QPointF::dotProduct(p - a, along) / square, 0.0, 1.0) : 0;
  return distance(p, a + t * along);
}

}  // namespace prt::ui
