#include "ui/model/field_look.h"

namespace prt::ui {

namespace {

constexpr double kReach = 0.42;  // half of a line, relative to the distance of points
constexpr double kHead = 0.3;    // of an arrow, relative to its half
const Rgb kLineColor(1.0f, 0.93f, 0.72f);

}  // namespace

SurfaceMarks fieldLines(const PaintSurface& on, const OrientationField& field) {
  SurfaceMarks marks;
  marks.color = kLineColor;
  marks.hidden = 0;
  marks.size = 0.6f;
  const double half = kReach * double(on.spread.radius) * 1.3;  // points are rarely as near as they may be
  for (const SurfacePoint& point : on.spread.points) {
    const Vec3 normal = on.normalAt(point);
    const DVec3 along(tangentAt(field.frames, point.triangle, point.barycentric, normal));
    const DVec3 across = cross(DVec3(normal), along);
    const auto place = [&](const DVec3& way) { return positionAt(on.surface, walk(on.surface, point, way)); };
    const auto line = [&](const Vec3& a, const Vec3& b) {
      marks.edges.push_back(a);
      marks.edges.push_back(b);
    };
    const Vec3 tip = place(half * along);
    line(place(-half * along), tip);
    if (field.symmetry == 4) line(place(-half * across), place(half * across));
    if (field.symmetry == 1)
      for (const double side : {-kHead, kHead})
        line(tip, place(half * ((1 - 1.2 * kHead) * along + side * across)));
  }
  return marks;
}

std::vector<FieldKnot> fieldKnots(const Surface& surface, const OrientationField& field) {
  std::vector<FieldKnot> knots;
  for (const FieldSingularity& each : field.singularities)
    knots.push_back({positionAt(surface, {each.triangle, Vec2(1.0f / 3)}), each.index});
  return knots;
}

}  // namespace prt::ui
