#include "libprt/light/environment_mapping.h"

#include "libprt/basis/quadrature.h"
#include "libprt/core/error.h"

#include <algorithm>
#include <array>

namespace prt {
namespace {

struct MappingName {
  EnvironmentMapping mapping;
  const char* name;
  int cellsX, cellsY;  // 0 = not made of cells
};

constexpr std::array<MappingName, 6> kMappings{{{EnvironmentMapping::LatLong, "latlong", 0, 0},
                                                {EnvironmentMapping::VerticalCross, "vcross", 3, 4},
                                                {EnvironmentMapping::HorizontalCross, "hcross", 4, 3},
                                                {EnvironmentMapping::AngularMap, "angular", 0, 0},
                                                {EnvironmentMapping::HorizontalStrip, "hstrip", 6, 1},
                                                {EnvironmentMapping::VerticalStrip, "vstrip", 1, 6}}};

constexpr std::array<EnvironmentMapping, 6> kAll{
    EnvironmentMapping::LatLong,    EnvironmentMapping::VerticalCross,   EnvironmentMapping::HorizontalCross,
    EnvironmentMapping::AngularMap, EnvironmentMapping::HorizontalStrip, EnvironmentMapping::VerticalStrip};

const MappingName& info(EnvironmentMapping mapping) {
  return kMappings[std::size_t(mapping)];
}

const IntervalRule& legendre(int order) {
  static const auto rules = [] {
    std::array<IntervalRule, 33> all;
    for (std::size_t n = 1; n < all.size(); ++n) all[n] = gaussLegendre(int(n));
    return all;
  }();
  return rules[std::size_t(std::clamp(order, 1, 32))];
}

/// Calls f(node, weight) for a Gauss-Legendre rule on [a, b].
template <class F>
void onInterval(double a, double b, int order, F&& f) {
  const IntervalRule& rule = legendre(order);
  for (std::size_t i = 0; i < rule.nodes.size(); ++i)
    f(0.5 * (a + b) + 0.5 * (b - a) * rule.nodes[i], 0.5 * (b - a) * rule.weights[i]);
}

/// sin(t)/t with its limit at zero.
double sinc(double t) {
  return t < 1e-4 ? 1 - t * t / 6 : std::sin(t) / t;
}

/// Half the chord of the unit disc at abscissa x.
double halfChord(double x) {
  return std::sqrt(std::max(0.0, 1 - x * x));
}

/// The coordinate of pixel i's range nearest to the centre of a disc `size` pixels wide, in [-1, 1].
double nearestToCentre(int i, int size) {
  const double a = 2.0 * i / size - 1, b = 2.0 * (i + 1) / size - 1;
  return a > 0 ? a : b < 0 ? b : 0.0;
}

/// Nodes of a product rule over the part of a rectangle that lies in the unit disc: f(x, y, area weight).
/// The range of x is cut where the circle crosses the rectangle's horizontal edges, so that each piece
/// is smooth.
template <class F>
void overDisc(double x0, double x1, double y0, double y1, int order, F&& f) {
  std::array<double, 6> cuts{std::max(x0, -1.0), -halfChord(y0), halfChord(y0),
                             -halfChord(y1),     halfChord(y1),  std::min(x1, 1.0)};
  for (double& cut : cuts) cut = std::clamp(cut, cuts[0], std::max(cuts[0], cuts[5]));
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (cuts[i + 1] - cuts[i] < 1e-15) continue;
    onInterval(cuts[i], cuts[i + 1], order, [&](double x, double wx) {
      const double low = std::max(y0, -halfChord(x)), high = std::min(y1, halfChord(x));
      if (low < high) onInterval(low, high, order, [&](double y, double wy) { f(x, y, wx * wy); });
    });
  }
}

}  // namespace

/// One picture of a cube: its cell in the image and the directions of its axes. A point (u, v) of
/// [-1, 1]^2 (v down) looks along center + u * right + v * down.
struct MapGeometry::Face {
  int column, row;
  DVec3 center, right, down;
};

std::span<const MapGeometry::Face> MapGeometry::faces() const {
  static const DVec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  static const auto place = [](std::array<std::array<int, 2>, 6> cells, bool backTurned) {
    // in strip order: right, left, top, bottom, front, back
    std::array<Face, 6> all{{{0, 0, x, z, -y},
                             {0, 0, -x, -z, -y},
                             {0, 0, y, x, -z},
                             {0, 0, -y, x, z},
                             {0, 0, -z, x, -y},
                             {0, 0, z, -x, -y}}};
    for (std::size_t i = 0; i < 6; ++i) all[i].column = cells[i][0], all[i].row = cells[i][1];
    if (backTurned) all[5].right = x, all[5].down = y;
    return all;
  };
  static const auto vcross = place({{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {1, 3}}}, true);
  static const auto hcross = place({{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}}, false);
  static const auto hstrip = place({{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}}}, false);
  static const auto vstrip = place({{{0, 0}, {0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}}, false);
  switch (mapping_) {
    case EnvironmentMapping::VerticalCross:
      return vcross;
    case EnvironmentMapping::HorizontalCross:
      return hcross;
    case EnvironmentMapping::HorizontalStrip:
      return hstrip;
    case EnvironmentMapping::VerticalStrip:
      return vstrip;
    default:
      return {};
  }
}

std::string toString(EnvironmentMapping mapping) {
  return info(mapping).name;
}

EnvironmentMapping environmentMappingFromString(const std::string& name) {
  for (const MappingName& m : kMappings)
    if (name == m.name) return m.mapping;
  throw ValueError("unknown mapping '" + name + "'", "environment map",
                   "use latlong, vcross, hcross, angular, hstrip or vstrip");
}

std::span<const EnvironmentMapping> environmentMappings() {
  return kAll;
}

bool fitsMapping(EnvironmentMapping mapping, int width, int height) {
  if (width < 1 || height < 1) return false;
  if (mapping == EnvironmentMapping::LatLong) return true;
  if (mapping == EnvironmentMapping::AngularMap) return width == height;
  const MappingName& m = info(mapping);
  return width % m.cellsX == 0 && height % m.cellsY == 0 && width / m.cellsX == height / m.cellsY;
}

MapGeometry::MapGeometry(EnvironmentMapping mapping, int width, int height)
    : mapping_(mapping), width_(width), height_(height) {
  if (!fitsMapping(mapping, width, height))
    throw ValueError("an image of " + std::to_string(width) + " x " + std::to_string(height) +
                         " cannot be a " + toString(mapping) + " map",
                     "environment map", "name the right mapping or crop the image");
  if (info(mapping).cellsX) cell_ = width / info(mapping).cellsX;
}

const MapGeometry::Face* MapGeometry::faceAt(double x, double y) const {
  const int column = int(x / cell_), row = int(y / cell_);
  for (const Face& face : faces())
    if (face.column == column && face.row == row) return &face;
  return nullptr;
}

bool MapGeometry::covers(int x, int y) const {
  if (mapping_ == EnvironmentMapping::LatLong) return true;
  if (cell_) return faceAt(x + 0.5, y + 0.5) != nullptr;
  // The point nearest to the centre decides whether a square reaches into the disc.
  const double u = nearestToCentre(x, width_), v = nearestToCentre(y, width_);
  return u * u + v * v < 1;
}

Vec2 MapGeometry::toImage(const Vec3& d) const {
  // Up to the last float below the edge: the pixel index is valid whatever the direction; NaN gives 0.
  const auto below = [](float t, int size) {
    return std::min(std::max(0.0f, t), std::nextafter(float(size), 0.0f));
  };
  const auto inside = [&](float x, float y) { return Vec2(below(x, width_), below(y, height_)); };
  if (mapping_ == EnvironmentMapping::LatLong) {
    const float azimuth = std::atan2(d.x, -d.z);
    const float polar = std::atan2(std::hypot(d.x, d.z), d.y);
    return inside((azimuth / (2 * kPiF) + 0.5f) * float(width_), polar / kPiF * float(height_));
  }
  if (mapping_ == EnvironmentMapping::AngularMap) {
    const float across = std::hypot(d.x, d.y);
    const float radius = std::atan2(across, -d.z) / kPiF;
    const Vec2 toward = across > 0 ? Vec2(d.x, d.y) / across : Vec2(1, 0);
    return inside((1 + radius * toward.x) * 0.5f * float(width_),
                  (1 - radius * toward.y) * 0.5f * float(height_));
  }
  const Face* best = faces().data();
  float along = 0;
  for (const Face& face : faces())
    if (const float a = dot(Vec3(face.center), d); a > along) along = a, best = &face;
  const auto onFace = [&](float t) { return below((1 + t) * 0.5f * float(cell_), cell_); };
  return inside(float(best->column * cell_) + onFace(dot(Vec3(best->right), d) / along),
                float(best->row * cell_) + onFace(dot(Vec3(best->down), d) / along));
}

DVec3 MapGeometry::toDirection(double x, double y) const {
  if (mapping_ == EnvironmentMapping::LatLong) {
    const double azimuth = (x / width_ - 0.5) * 2 * kPi, polar = y / height_ * kPi;
    return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
  }
  if (mapping_ == EnvironmentMapping::AngularMap) {
    const double u = 2 * x / width_ - 1, v = 1 - 2 * y / height_;
    const double angle = kPi * std::hypot(u, v);
    if (angle > kPi * (1 + 1e-12)) return DVec3(0);  // rounding may lift the rim's points over it
    const double across = kPi * sinc(angle);
    return {u * across, v * across, -std::cos(angle)};
  }
  const Face* face = faceAt(x, y);
  if (!face) return DVec3(0);
  const double u = 2 * (x / cell_ - face->column) - 1, v = 2 * (y / cell_ - face->row) - 1;
  return normalize(face->center + u * face->right + v * face->down);
}

double MapGeometry::density(double x, double y) const {
  if (mapping_ == EnvironmentMapping::LatLong)
    return std::sin(y / height_ * kPi) * (kPi / height_) * (2 * kPi / width_);
  if (mapping_ == EnvironmentMapping::AngularMap) {
    const double angle = kPi * std::hypot(2 * x / width_ - 1, 2 * y / height_ - 1);
    return angle > kPi ? 0 : kPi * kPi * sinc(angle) * (2.0 / width_) * (2.0 / width_);
  }
  const Face* face = faceAt(x, y);
  if (!face) return 0;
  const double u = 2 * (x / cell_ - face->column) - 1, v = 2 * (y / cell_ - face->row) - 1;
  return std::pow(1 + u * u + v * v, -1.5) * (2.0 / cell_) * (2.0 / cell_);
}

double MapGeometry::solidAngle(int x, int y) const {
  if (!covers(x, y)) return 0;
  if (mapping_ == EnvironmentMapping::LatLong)
    // cos a - cos b as a product, which keeps its digits at the poles
    return 2 * std::sin(kPi * (y + 0.5) / height_) * std::sin(0.5 * kPi / height_) * (2 * kPi / width_);
  if (cell_) {
    const double step = 2.0 / cell_, u = (x % cell_) * step - 1, v = (y % cell_) * step - 1;
    return planeRectangleSolidAngle(u, v, u + step, v + step);
  }
  const double step = 2.0 / width_, u = x * step - 1, v = y * step - 1;
  double area = 0;
  overDisc(u, u + step, v, v + step, width_ >= 128 ? 3 : 12,
           [&](double a, double b, double w) { area += w * kPi * kPi * sinc(kPi * std::hypot(a, b)); });
  return area;
}

/// Where a texel extends to from left to right.
MapGeometry::Range MapGeometry::columns(int x, int y) const {
  Range range{double(x), double(x) + 1};
  if (mapping_ == EnvironmentMapping::AngularMap) {
    const double half = 0.5 * width_, reach = half * halfChord(nearestToCentre(y, width_));
    range = {std::max(range.low, half - reach), std::min(range.high, half + reach)};
  }
  return range;
}

/// Where a texel of row y extends to from top to bottom, at abscissa x.
MapGeometry::Range MapGeometry::rows(int y, double x) const {
  Range range{double(y), double(y) + 1};
  if (mapping_ == EnvironmentMapping::AngularMap) {
    const double half = 0.5 * height_, reach = half * halfChord(x / half - 1);
    range = {std::max(range.low, half - reach), std::min(range.high, half + reach)};
  }
  return range;
}

glm::dvec2 MapGeometry::pointInTexel(int x, int y, double u, double v) const {
  const Range across = columns(x, y);
  const double px = glm::mix(across.low, across.high, u);
  const Range down = rows(y, px);
  return {px, glm::mix(down.low, std::max(down.low, down.high), v)};
}

double MapGeometry::pointDensity(double x, double y) const {
  if (mapping_ != EnvironmentMapping::AngularMap) return 1;
  const Range across = columns(int(x), int(y)), down = rows(int(y), x);
  const double area = (across.high - across.low) * (down.high - down.low);
  return area > 0 ? 1 / area : 0;
}

std::vector<TexelNode> MapGeometry::nodes(int x, int y, int order) const {
  std::vector<TexelNode> result;
  if (!covers(x, y)) return result;
  const auto add = [&](double px, double py, double area) {
    result.push_back({toDirection(px, py), area * density(px, py)});
  };
  if (mapping_ == EnvironmentMapping::AngularMap) {
    const double step = 2.0 / width_;
    overDisc(
        x * step - 1, (x + 1) * step - 1, y * step - 1, (y + 1) * step - 1, order,
        [&](double u, double v, double area) { add((u + 1) / step, (v + 1) / step, area / (step * step)); });
  } else {
    onInterval(x, x + 1, order, [&](double px, double wx) {
      onInterval(y, y + 1, order, [&](double py, double wy) { add(px, py, wx * wy); });
    });
  }
  double sum = 0;
  for (const TexelNode& node : result) sum += node.weight;
  const double scale = sum > 0 ? solidAngle(x, y) / sum : 0;
  for (TexelNode& node : result) node.weight *= scale;
  return result;
}

DVec3 MapGeometry::center(int x, int y) const {
  if (mapping_ != EnvironmentMapping::AngularMap || !covers(x, y)) return toDirection(x + 0.5, y + 0.5);
  const double step = 2.0 / width_;
  double u = 0, v = 0, area = 0;
  overDisc(x * step - 1, (x + 1) * step - 1, y * step - 1, (y + 1) * step - 1, 2,
           [&](double a, double b, double w) { u += w * a, v += w * b, area += w; });
  return area > 0 ? toDirection((u / area + 1) / step, (v / area + 1) / step) : DVec3(0, 0, 1);
}

double MapGeometry::texelAngle() const {
  if (mapping_ == EnvironmentMapping::LatLong) return std::max(kPi / height_, 2 * kPi / width_);
  // at the centre of a cube face; along the radius of an angular map
  return cell_ ? 2.0 / cell_ : 2 * kPi / width_;
}

}  // namespace prt
