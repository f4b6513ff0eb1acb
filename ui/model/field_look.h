#pragma once
// An orientation field as it is shown on the surface: short lines along it, and the places where it winds.

#include "libprt/shade/surface_overlay.h"
#include "libprt/synthesis/orientation_field.h"
#include "ui/model/painting.h"

#include <vector>

namespace prt::ui {

/// Lines along the field all over the surface: arrows where a turn by half does not leave it as it is,
/// crosses where a quarter turn does.
SurfaceMarks fieldLines(const PaintSurface& on, const OrientationField& field);

/// A place where the field winds: the middle of a triangle.
struct FieldKnot {
  Vec3 position{0};
  int index = 0;  ///< turns of the field there, in units of 1 / symmetry
};
std::vector<FieldKnot> fieldKnots(const Surface& surface, const OrientationField& field);

}  // namespace prt::ui
