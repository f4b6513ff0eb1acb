#include "libprt/synthesis/orientation_field.h"

#include "libprt/atlas/sparse_cholesky.h"
#include "libprt/core/error.h"
#include "libprt/core/sampling.h"
#include "libprt/mesh/cancel_check.h"
#include "libprt/synthesis/vertex_connection.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

using Field = std::vector<Complex>;  // [W] e^{i N angle}, times a length that says how sure it is

constexpr std::size_t kMostForSolver = 150'000;  // vertices; larger surfaces are smoothed step by step
constexpr int kIterations = 10, kSweeps = 200;
constexpr double kStrokePull = 100;  // against the edges around a vertex

Complex unit(const Complex& z) {
  const double size = std::abs(z);
  return size > 1e-300 ? z / size : Complex(1, 0);
}

Complex power(double angle, int n) {
  return std::polar(1.0, n * angle);
}

/// The normal of every vertex of the surface, by angle.
std::vector<DVec3> vertexNormals(const VertexConnection& c) {
  const Surface& s = c.surface;
  std::vector<DVec3> normals(s.positions.size(), DVec3(0));
  for (std::uint32_t h = 0; h < 3 * s.triangleCount(); ++h) {
    const DVec3 n = s.areaNormal(h / 3);
    if (dot(n, n) > 0) normals[s.from(h)] += double(c.cornerAngle[h]) * normalize(n);
  }
  for (DVec3& n : normals) n = dot(n, n) > 0 ? normalize(n) : DVec3(0, 1, 0);
  return normals;
}

/// A vector at every vertex as e^{i N angle}: the mean over its corners.
Field fieldOfVectors(const VertexConnection& c, const std::vector<DVec3>& vectors, int n) {
  Field z(vectors.size(), 0);
  for (std::uint32_t h = 0; h < 3 * c.surface.triangleCount(); ++h) {
    const DVec3& v = vectors[c.surface.from(h)];
    if (dot(v, v) > 0)
      z[c.surface.from(h)] += double(c.cornerAngle[h]) * length(v) * power(c.angleOf(h, v), n);
  }
  return z;
}

/// The general course: eastwards, and along +X on level ground.
Field generalCourse(const VertexConnection& c, int n) {
  std::vector<DVec3> vectors;
  for (const DVec3& normal : vertexNormals(c))
    vectors.push_back(cross(DVec3(0, 1, 0), normal) + 0.5 * (DVec3(1, 0, 0) - normal.x * normal));
  return fieldOfVectors(c, vectors, n);
}

// ---------------------------------------------------------------------------------------------------------
// Strokes

struct Pull {
  Field towards;             ///< [W] 0 where no stroke is near
  std::vector<bool> pulled;  ///< [components]
  bool any = false;
};

/// A straight piece of a stroke, no longer than the stroke is wide where that takes few pieces.
struct StrokePiece {
  DVec3 from, way;                                            // way: to its other end
  std::pair<double, std::uint32_t> nearest{1e300, kNowhere};  // squared distance and number of a vertex
};

std::vector<StrokePiece> piecesOf(const FieldStroke& stroke, double width) {
  constexpr double kMost = 64;  // of one straight line
  std::vector<StrokePiece> pieces;
  for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i) {
    const DVec3 a(stroke.points[i]), d = DVec3(stroke.points[i + 1]) - a;
    const double size = length(d);
    if (!(size > 0)) continue;
    const int count = int(std::ceil(std::min(size / std::max(width, 1e-300), kMost)));
    for (int k = 0; k < count; ++k) pieces.push_back({a + d * (double(k) / count), d / double(count)});
  }
  return pieces;
}

/// The piece that passes nearest to a point, and the squared distance.
std::pair<double, std::uint32_t> nearestPiece(const DVec3& p, const std::vector<StrokePiece>& pieces) {
  std::pair<double, std::uint32_t> best{1e300, kNowhere};
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    const auto& [a, d, nearest] = pieces[i];
    const DVec3 q = a + std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0) * d;
    if (const double d2 = dot(p - q, p - q); d2 < best.first) best = {d2, i};
  }
  return best;
}

double longestEdge2(const Surface& s, std::uint32_t v) {
  double most = 0;
  for (std::uint32_t i = s.spokeStart[v]; i < s.spokeStart[v + 1]; ++i)
    most = std::max(most, s.length(s.spokes[i]) * s.length(s.spokes[i]));
  return most;
}

Pull pullOfStrokes(const VertexConnection& c, const FieldOptions& options, Job& job) {
  const Surface& s = c.surface;
  Pull pull{Field(s.positions.size(), 0), std::vector<bool>(c.components, false), false};
  if (options.strokes.empty()) return pull;
  Box3 box;
  for (const Vec3& p : s.positions) box.extend(p);
  const double width = options.strokeWidth * double(box.diagonal());
  const std::vector<DVec3> normals = vertexNormals(c);
  std::vector<DVec3> vectors(s.positions.size(), DVec3(0));
  CancelCheck check(job);
  for (const FieldStroke& stroke : options.strokes) {
    // The vertex nearest to each piece says which side of the surface is meant there.
    std::vector<StrokePiece> pieces = piecesOf(stroke, width);
    if (pieces.empty()) continue;
    std::vector<std::pair<double, std::uint32_t>> found(s.positions.size());
    for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
      check();
      found[v] = nearestPiece(DVec3(s.positions[v]), pieces);
      auto& nearest = pieces[found[v].second].nearest;
      nearest = std::min(nearest, {found[v].first, v});
    }
    double closest = 1e300;
    for (const StrokePiece& piece : pieces) closest = std::min(closest, piece.nearest.first);
    for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
      const auto [d2, piece] = found[v];
      const auto [least, nearest] = pieces[piece].nearest;
      // On a mesh coarser than the stroke is wide, the vertices that it passes nearest to.
      const bool caught = v == nearest && (d2 <= longestEdge2(s, v) || least == closest);
      const bool inBand = d2 <= width * width && c.component[v] == c.component[nearest] &&
                          dot(normals[v], normals[nearest]) > 0;
      if (!caught && !inBand) continue;
      const double closeness = std::max(0.05, 1 - std::sqrt(d2) / std::max(width, 1e-300));
      vectors[v] += closeness * normalize(pieces[piece].way);
      pull.pulled[c.component[v]] = pull.any = true;
    }
  }
  pull.towards = fieldOfVectors(c, vectors, options.symmetry);
  for (std::size_t v = 0; v < vectors.size(); ++v)
    if (dot(vectors[v], vectors[v]) > 0) pull.towards[v] = unit(pull.towards[v]);
  return pull;
}

// ---------------------------------------------------------------------------------------------------------
// The smoothest field

/// Every component's field to a mean square of 1: each has an eigenvector of its own.
void normalise(const VertexConnection& c, Field& z) {
  std::vector<double> size(c.components, 0), mass(c.components, 0);
  for (std::size_t v = 0; v < z.size(); ++v)
    size[c.component[v]] += c.mass[v] * std::norm(z[v]), mass[c.component[v]] += c.mass[v];
  for (std::size_t v = 0; v < z.size(); ++v) {
    const double s = size[c.component[v]];
    if (s > 0) z[v] *= std::sqrt(mass[c.component[v]] / s);
  }
}

class SmoothestField {
 public:
  SmoothestField(const VertexConnection& c, int n, const Pull& pull, Job& job)
      : c_(c), edges_(edgesOf(c.surface)), matrix_(c.surface.positions.size(), edges_, job) {
    double stiffness = 0, mass = 0;
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      const double w = c.weight[e], turn = n * c.transport(c.surface.halfOf[e]);
      matrix_.addDiagonal(edges_[e].first, {w, 0, 0, w});
      matrix_.addDiagonal(edges_[e].second, {w, 0, 0, w});
      // The first vertex' row of  |z_b - e^{i turn} z_a|^2.
      matrix_.addEdge(e, {-w * std::cos(turn), -w * std::sin(turn), w * std::sin(turn), -w * std::cos(turn)});
      stiffness += 2 * w;
    }
    for (const double m : c.mass) mass += m;
    for (std::uint32_t v = 0; v < c.mass.size(); ++v) {
      const double shift = 1e-9 * stiffness / mass * c.mass[v];
      const double held = pull.towards[v] == 0.0 ? 0 : kStrokePull;
      matrix_.addDiagonal(v, {shift + held, 0, 0, shift + held});
    }
    ready_ = matrix_.factorise(job);
  }
  bool ready() const { return ready_; }
  Field solve(const Field& right) const {
    std::vector<SparseCholesky<2>::Vector> x(right.size());
    for (std::size_t v = 0; v < x.size(); ++v) x[v] = {right[v].real(), right[v].imag()};
    matrix_.solve(x);
    Field z(x.size());
    for (std::size_t v = 0; v < x.size(); ++v) z[v] = {x[v][0], x[v][1]};
    return z;
  }

 private:
  static std::vector<std::pair<std::uint32_t, std::uint32_t>> edgesOf(const Surface& s) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t e = 0; e < s.edgeCount(); ++e) edges.emplace_back(s.ends(e).x, s.ends(e).y);
    return edges;
  }
  const VertexConnection& c_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges_;
  SparseCholesky<2> matrix_;
  bool ready_ = false;
};

/// Gauss-Seidel, for surfaces too large to factorise: good away from singularities, which it leaves where
/// the general course put them.
Field smoothed(const VertexConnection& c, int n, const Pull& pull, Field z, Job& job) {
  const Surface& s = c.surface;
  CancelCheck check(job);
  for (std::size_t v = 0; v < z.size(); ++v)
    if (pull.towards[v] != 0.0) z[v] = pull.towards[v];
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::uint32_t v = 0; v < z.size(); ++v) {
      check();
      Complex sum = kStrokePull * pull.towards[v];
      for (std::uint32_t i = s.spokeStart[v]; i < s.spokeStart[v + 1]; ++i) {
        const std::uint32_t e = s.spokes[i], half = s.halfOf[e];
        const double turn = n * c.transport(half);
        sum += c.weight[e] * (s.to(half) == v ? std::polar(1.0, turn) * z[s.from(half)]
                                              : std::polar(1.0, -turn) * z[s.to(half)]);
      }
      z[v] = unit(sum);
    }
  return z;
}

Field smoothestField(const VertexConnection& c, const FieldOptions& options, Job& job) {
  const int n = options.symmetry;
  const Pull pull = pullOfStrokes(c, options, job);
  const Field course = generalCourse(c, n);
  if (c.surface.positions.size() > kMostForSolver) return smoothed(c, n, pull, course, job);
  // Inverse iteration, begun with the general course and a little of everything.
  Field z = course;
  for (std::size_t v = 0; v < z.size(); ++v)
    z[v] = unit(z[v]) + 0.01 * std::polar(1.0, 2 * kPi * double(hashUniform(1, v)));
  const Pull none{Field(z.size(), 0), {}, false};
  {
    const SmoothestField free(c, n, none, job);
    if (!free.ready()) return smoothed(c, n, pull, course, job);
    for (int i = 0; i < kIterations; ++i) {
      job.checkCancelled();
      for (std::size_t v = 0; v < z.size(); ++v) z[v] *= c.mass[v];
      z = free.solve(z);
      normalise(c, z);
    }
  }
  // An eigenvector is known but for a turn of all of it: the one that suits the general course best.
  std::vector<Complex> turn(c.components, 0);
  for (std::size_t v = 0; v < z.size(); ++v) turn[c.component[v]] += c.mass[v] * std::conj(z[v]) * course[v];
  for (std::size_t v = 0; v < z.size(); ++v) z[v] *= unit(turn[c.component[v]]) * power(options.angle, n);
  if (!pull.any) return z;
  const SmoothestField held(c, n, pull, job);
  if (!held.ready()) return smoothed(c, n, pull, z, job);
  Field right = pull.towards;
  for (Complex& r : right) r *= kStrokePull;
  const Field followed = held.solve(right);
  for (std::size_t v = 0; v < z.size(); ++v)
    if (pull.pulled[c.component[v]]) z[v] = followed[v];
  return z;
}

// ---------------------------------------------------------------------------------------------------------
// From the field to tangents

/// One of the N angles at every vertex, so that neighbours along a spanning tree agree.
std::vector<double> combed(const VertexConnection& c, const Field& z, int n) {
  const Surface& s = c.surface;
  const double step = 2 * kPi / n;
  std::vector<double> angle(z.size());
  std::vector<bool> seen(z.size(), false);
  std::vector<std::uint32_t> queue;
  for (std::uint32_t seed = 0; seed < z.size(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = true;
    angle[seed] = std::arg(z[seed]) / n;
    queue.assign(1, seed);
    for (std::size_t i = 0; i < queue.size(); ++i) {
      const std::uint32_t v = queue[i];
      for (std::uint32_t k = s.spokeStart[v]; k < s.spokeStart[v + 1]; ++k) {
        const std::uint32_t half = s.halfOf[s.spokes[k]], other = s.across(s.spokes[k], v);
        if (seen[other]) continue;
        seen[other] = true;
        const double carried = angle[v] + (s.from(half) == v ? c.transport(half) : -c.transport(half));
        const double own = std::arg(z[other]) / n;
        angle[other] = own + step * std::round((carried - own) / step);
        queue.push_back(other);
      }
    }
  }
  return angle;
}

Vec3 flatUnit(const DVec3& v, const DVec3& n) {
  const DVec3 flat = v - dot(v, n) * n;
  return dot(flat, flat) > 1e-20 ? Vec3(normalize(flat)) : frameFromNormal(Vec3(n)).tangent;
}

TangentFrames framesOf(const TriMesh& mesh, const VertexConnection& c, const Field& z, int n) {
  const Surface& s = c.surface;
  const std::vector<double> angle = combed(c, z, n);
  // Corners that share a vertex of the mesh, hence a normal, share a tangent. (Creases do not.)
  std::vector<DVec3> sums(mesh.vertexCount(), DVec3(0));
  for (std::uint32_t h = 0; h < 3 * s.triangleCount(); ++h) {
    const std::uint32_t v = mesh.triangles[h / 3][int(h % 3)];
    const DVec3 d = c.direction(h, angle[s.from(h)]), normal(mesh.normals[v]);
    sums[v] += double(c.cornerAngle[h]) * (d - dot(d, normal) * normal);
  }
  TangentFrames frames;
  frames.tangents.resize(3 * s.triangleCount());
  for (std::uint32_t t = 0; t < s.triangleCount(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = mesh.triangles[t][i];
      const DVec3 normal(mesh.normals[v]);
      Vec3 tangent = flatUnit(sums[v], normal);
      if (i > 0 && n > 1) {
        // The branch of the first corner.
        const DVec3 first(frames.tangents[3 * t]);
        const double turn = std::atan2(dot(first, cross(normal, DVec3(tangent))), dot(first, DVec3(tangent)));
        const double branch = std::round(turn * n / (2 * kPi)) * 2 * kPi / n;
        tangent = flatUnit(
            std::cos(branch) * DVec3(tangent) + std::sin(branch) * cross(normal, DVec3(tangent)), normal);
      }
      frames.tangents[3 * t + std::uint32_t(i)] = tangent;
    }
  return frames;
}

/// Index theorem, triangle by triangle.
std::vector<FieldSingularity> findSingularities(const VertexConnection& c, const Field& z, int n) {
  const Surface& s = c.surface;
  std::vector<FieldSingularity> found;
  for (std::uint32_t t = 0; t < s.triangleCount(); ++t) {
    double sum = n * c.curvature(t);
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      sum += std::arg(z[s.to(h)] * std::conj(z[s.from(h)]) * std::polar(1.0, -n * c.transport(h)));
    const int index = int(std::lround(sum / (2 * kPi)));
    if (index != 0) found.push_back({t, index});
  }
  return found;
}

}  // namespace

OrientationField makeOrientationField(const TriMesh& mesh, const Surface& surface,
                                      const FieldOptions& options, Job& job) {
  if (options.symmetry != 1 && options.symmetry != 2 && options.symmetry != 4)
    throw ValueError(std::to_string(options.symmetry) + " is no symmetry of a field", "field.symmetry",
                     "use 1, 2 or 4");
  job.begin("orientation field", 0);
  const VertexConnection connection(surface, job);
  const Field z = smoothestField(connection, options, job);
  OrientationField field;
  field.symmetry = options.symmetry;
  field.frames = framesOf(mesh, connection, z, options.symmetry);
  field.singularities = findSingularities(connection, z, options.symmetry);
  return field;
}

Vec3 tangentAt(const TangentFrames& frames, std::uint32_t triangle, const Vec2& barycentric,
               const Vec3& normal) {
  const Vec3* t = &frames.tangents[3 * std::size_t(triangle)];
  const Vec3 sum = interpolated(t[0], t[1], t[2], barycentric);
  const Vec3 flat = sum - dot(sum, normal) * normal;
  if (dot(flat, flat) > 1e-8f) return normalize(flat);
  const Vec3 first = t[0] - dot(t[0], normal) * normal;
  return dot(first, first) > 1e-8f ? normalize(first) : frameFromNormal(normal).tangent;
}

}  // namespace prt
