#pragma once
// What the picture says about itself: method, bands, bake level, frame time, estimated error; and, while
// there is no picture, what can be done.

#include "ui/viewport/canvas.h"

#include <QSize>

namespace prt::ui {

class Session;

/// Draws over the picture, in logical pixels of a viewport of this size. Without a canvas no frame time.
void paintOverlay(QPainter& painter, const QSize& size, Session& session, const Canvas* canvas);

}  // namespace prt::ui
