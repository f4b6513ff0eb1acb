#include "libprt/atlas/symmetric_dirichlet.h"

#include "libprt/atlas/boundary_polygon.h"
#include "libprt/atlas/orientation.h"
#include "libprt/mesh/cancel_check.h"

#include <algorithm>
#include <limits>

namespace prt {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// A triangle flatter than this is taken as if it were so high: its shape is noise, its orientation is not.
constexpr double kLeastHeight = 1e-3;  // of its longest side
constexpr double kLeastArea = 1e-6;    // of the mean: what little ones weigh at least

struct Mat2 {
  double a, b, c, d;  // row by row
};

constexpr double kEasy = 10;  // energy of a triangle, 4 at least, up to which it is taken as it is

constexpr double kReach = 0.3;      // of the repulsion, in mean boundary sides
constexpr double kRepulsion = 0.1;  // its weight

struct Near {
  double distance, t;  // t along the side
  DVec2 normal;        // from the side to the point
};

Near distanceOf(const DVec2& p, const DVec2& a, const DVec2& b) {
  const DVec2 along = b - a;
  const double length2 = dot(along, along);
  const double t = length2 > 0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  const DVec2 d = p - (a + along * t);
  const double distance = glm::length(d);
  return {distance, t, distance > 0 ? d / distance : DVec2(0)};
}

Mat2 jacobian(const DVec2 gradients[3], const DVec2& u0, const DVec2& u1, const DVec2& u2) {
  return {u0.x * gradients[0].x + u1.x * gradients[1].x + u2.x * gradients[2].x,
          u0.x * gradients[0].y + u1.x * gradients[1].y + u2.x * gradients[2].y,
          u0.y * gradients[0].x + u1.y * gradients[1].x + u2.y * gradients[2].x,
          u0.y * gradients[0].y + u1.y * gradients[1].y + u2.y * gradients[2].y};
}

/// f(s1) + f(s2) with f(s) = s^2 + s^-2, from the norm and the determinant alone.
double energyOf(const Mat2& j) {
  const double det = j.a * j.d - j.b * j.c, norm = j.a * j.a + j.b * j.b + j.c * j.c + j.d * j.d;
  return det > 0 ? norm * (1 + 1 / (det * det)) : kInfinite;
}

/// J = R(left) diag(s1, s2) R(right), s1 >= |s2|, as cosines and sines of the two turns.
struct Svd {
  double s1, s2, cl, sl, cr, sr;
};

Svd svdOf(const Mat2& m) {
  const double e = 0.5 * (m.a + m.d), f = 0.5 * (m.a - m.d), g = 0.5 * (m.c + m.b), h = 0.5 * (m.c - m.b);
  const double q = std::hypot(e, h), r = std::hypot(f, g);
  const double a1 = std::atan2(g, f), a2 = std::atan2(h, e);
  const double right = 0.5 * (a2 - a1), left = 0.5 * (a2 + a1);
  return {q + r, q - r, std::cos(left), std::sin(left), std::cos(right), std::sin(right)};
}

double slope(double s) {
  return 2 * s - 2 / (s * s * s);
}
double curvature(double s) {
  const double s2 = s * s;
  return 2 + 6 / (s2 * s2);
}

/// U M V^T for the SVD's turns: U = R(left), V^T = R(right).
Mat2 turned(const Svd& v, const Mat2& m) {
  const Mat2 um{v.cl * m.a - v.sl * m.c, v.cl * m.b - v.sl * m.d, v.sl * m.a + v.cl * m.c,
                v.sl * m.b + v.cl * m.d};
  return {um.a * v.cr + um.b * v.sr, -um.a * v.sr + um.b * v.cr, um.c * v.cr + um.d * v.sr,
          -um.c * v.sr + um.d * v.cr};
}

DVec2 times(const Mat2& m, const DVec2& v) {
  return {m.a * v.x + m.b * v.y, m.c * v.x + m.d * v.y};
}

}  // namespace

SymmetricDirichlet::SymmetricDirichlet(const FlatChart& chart, bool fixedBoundary, Job& job)
    : chart_(chart), fixedBoundary_(fixedBoundary), unknown_(chart.positions.size(), 0) {
  const double leastArea = kLeastArea * chart.area / double(std::max<std::size_t>(1, chart.triangles.size()));
  rest_.reserve(chart.triangles.size());
  for (const UVec3& t : chart.triangles) {
    const DVec3 e1 = chart.positions[t.y] - chart.positions[t.x],
                e2 = chart.positions[t.z] - chart.positions[t.x];
    const double longest = std::max({glm::length(e1), glm::length(e2), glm::length(e2 - e1), 1e-150});
    const double base = std::max(glm::length(e1), 1e-9 * longest), along = glm::dot(e1, e2) / base;
    double height = glm::length(glm::cross(e1, e2)) / base;
    height = std::max(height, kLeastHeight * longest * longest / base);
    Rest rest;
    const double inverse = 1 / (base * height);
    rest.gradients[1] = DVec2(height, -along) * inverse;
    rest.gradients[2] = DVec2(0, base) * inverse;
    rest.gradients[0] = -rest.gradients[1] - rest.gradients[2];
    rest.area = std::max(0.5 * glm::length(glm::cross(e1, e2)), leastArea);
    restArea_ += rest.area;
    rest_.push_back(rest);
  }
  if (fixedBoundary)
    for (std::uint32_t v : chart.rim) unknown_[v] = kNowhere;
  std::uint32_t count = 0;
  for (std::uint32_t& u : unknown_)
    if (u != kNowhere) u = count++;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  slot_.assign(chart.edges.size(), kNowhere);
  for (std::uint32_t e = 0; e < chart.edges.size(); ++e) {
    const std::uint32_t a = unknown_[chart.edges[e].first], b = unknown_[chart.edges[e].second];
    if (a == kNowhere || b == kNowhere) continue;
    slot_[e] = std::uint32_t(edges.size());
    edges.emplace_back(a, b);
  }
  solver_ = std::make_unique<SparseCholesky<2>>(count, edges, job);
}

double SymmetricDirichlet::energy(const std::vector<DVec2>& uv) const {
  return meanEnergy(rest_, uv);
}

double SymmetricDirichlet::meanEnergy(const std::vector<Rest>& rest, const std::vector<DVec2>& uv) const {
  double sum = 0;
  for (std::size_t t = 0; t < rest.size(); ++t) {
    const UVec3& c = chart_.triangles[t];
    sum += rest[t].area * energyOf(jacobian(rest[t].gradients, uv[c.x], uv[c.y], uv[c.z]));
  }
  return sum / (4 * restArea_);
}

void SymmetricDirichlet::ease(const std::vector<DVec2>& uv, Job& job) {
  CancelCheck check(job);
  eased_ = rest_;
  isEased_ = false;
  for (std::size_t t = 0; t < rest_.size(); ++t) {
    check();
    const UVec3& c = chart_.triangles[t];
    Rest& rest = eased_[t];
    const Mat2 j = jacobian(rest.gradients, uv[c.x], uv[c.y], uv[c.z]);
    if (!(energyOf(j) > kEasy)) continue;
    isEased_ = true;
    const Svd v = svdOf(j);
    // J = U diag(s) V^T becomes U diag(s^share) V^T: the rest of it goes into the reference.
    double low = 0, high = 1;
    const double l1 = 2 * std::log(v.s1), l2 = 2 * std::log(std::max(v.s2, 1e-300));
    for (int i = 0; i < 20; ++i) {
      const double share = 0.5 * (low + high);
      (2 * (std::cosh(share * l1) + std::cosh(share * l2)) > kEasy ? high : low) = share;
    }
    const double a = std::exp(0.5 * (low - 1) * l1), b = std::exp(0.5 * (low - 1) * l2);  // s^(share - 1)
    // g' = V diag(s^(share - 1)) V^T g, V^T = R(right).
    for (DVec2& g : rest.gradients) {
      const DVec2 q(a * (v.cr * g.x - v.sr * g.y), b * (v.sr * g.x + v.cr * g.y));
      g = {v.cr * q.x + v.sr * q.y, -v.sr * q.x + v.cr * q.y};
    }
  }
}

void SymmetricDirichlet::assemble(const std::vector<DVec2>& uv, std::vector<std::array<double, 2>>& descent,
                                  Job& job) {
  constexpr double kRootHalf = 0.70710678118654752;
  CancelCheck check(job);
  solver_->clear();
  for (std::size_t t = 0; t < rest_.size(); ++t) {
    check();
    const UVec3& c = chart_.triangles[t];
    const DVec2* g = eased_[t].gradients;
    const double weight = rest_[t].area / restArea_;
    const Svd v = svdOf(jacobian(g, uv[c.x], uv[c.y], uv[c.z]));
    const double d1 = slope(v.s1), d2 = slope(v.s2);
    const Mat2 stress = turned(v, {d1, 0, 0, d2});
    // Eigenmatrices of the energy's Hessian: the two stretches, the twist and the flip.
    const Mat2 modes[4] = {turned(v, {1, 0, 0, 0}), turned(v, {0, 0, 0, 1}),
                           turned(v, {0, -kRootHalf, kRootHalf, 0}), turned(v, {0, kRootHalf, kRootHalf, 0})};
    const double gap = v.s1 - v.s2;
    const double values[4] = {curvature(v.s1), curvature(v.s2), std::max(0.0, (d1 + d2) / (v.s1 + v.s2)),
                              gap > 1e-6 * v.s1 ? (d1 - d2) / gap : curvature(v.s1)};
    DVec2 w[4][3];
    for (int m = 0; m < 4; ++m)
      for (int k = 0; k < 3; ++k) w[m][k] = times(modes[m], g[k]) * std::sqrt(weight * values[m]);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t u = unknown_[c[k]];
      if (u == kNowhere) continue;
      const DVec2 force = times(stress, g[k]) * weight;
      descent[u][0] -= force.x;
      descent[u][1] -= force.y;
      std::array<double, 4> block{};
      for (int m = 0; m < 4; ++m) {
        block[0] += w[m][k].x * w[m][k].x;
        block[1] += w[m][k].x * w[m][k].y;
        block[3] += w[m][k].y * w[m][k].y;
      }
      block[2] = block[1];
      solver_->addDiagonal(u, block);
      // The edge from corner k to the next, as its list has it: lower vertex first.
      const std::uint32_t edge = slot_[chart_.edgeOf[t][k]];
      if (edge == kNowhere) continue;
      int i = k, j = (k + 1) % 3;
      if (c[i] > c[j]) std::swap(i, j);
      std::array<double, 4> off{};
      for (int m = 0; m < 4; ++m) {
        off[0] += w[m][i].x * w[m][j].x;
        off[1] += w[m][i].x * w[m][j].y;
        off[2] += w[m][i].y * w[m][j].x;
        off[3] += w[m][i].y * w[m][j].y;
      }
      solver_->addEdge(edge, off);
    }
  }
}

double SymmetricDirichlet::largestStep(const std::vector<DVec2>& uv,
                                       const std::vector<DVec2>& direction) const {
  double least = kInfinite;
  for (const UVec3& t : chart_.triangles) {
    // Twice the area as a polynomial of the step: c + b x + a x^2.
    const DVec2 e1 = uv[t.y] - uv[t.x], e2 = uv[t.z] - uv[t.x];
    const DVec2 f1 = direction[t.y] - direction[t.x], f2 = direction[t.z] - direction[t.x];
    const double c = e1.x * e2.y - e1.y * e2.x, a = f1.x * f2.y - f1.y * f2.x;
    const double b = e1.x * f2.y - e1.y * f2.x + f1.x * e2.y - f1.y * e2.x;
    const double root = b * b - 4 * a * c;
    if (root < 0) continue;
    // The smallest positive root, without cancellation.
    const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
    for (const double x : {a != 0 ? q / a : kInfinite, q != 0 ? c / q : kInfinite})
      if (x > 0 && x < least) least = x;
  }
  return least;
}

bool SymmetricDirichlet::boundaryIsSimple(const std::vector<DVec2>& uv) const {
  std::vector<DVec2> boundary;
  boundary.reserve(chart_.rim.size());
  for (std::uint32_t v : chart_.rim) boundary.push_back(uv[v]);
  return !selfIntersects(boundary);
}

std::vector<SymmetricDirichlet::Contact> SymmetricDirichlet::contacts(const std::vector<DVec2>& uv) const {
  // Sides into square cells as wide as the reach, widened by it; then each vertex looks into its cell.
  const std::size_t n = chart_.rim.size();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> cells;
  DVec2 low = uv[chart_.rim[0]];
  double longest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    low = min(low, uv[chart_.rim[i]]);
    longest = std::max(longest, glm::distance(uv[chart_.rim[i]], uv[chart_.rim[(i + 1) % n]]));
  }
  low -= DVec2(reach_);
  const double cell = std::max(4 * reach_, longest / 16);
  const auto cellOf = [&](double value) { return std::uint64_t(std::max(0.0, value / cell)); };
  for (std::uint32_t i = 0; i < n; ++i) {
    const DVec2 a = uv[chart_.rim[i]] - low, b = uv[chart_.rim[(i + 1) % n]] - low;
    const DVec2 from = min(a, b) - DVec2(reach_), to = max(a, b) + DVec2(reach_);
    for (std::uint64_t y = cellOf(from.y); y <= cellOf(to.y); ++y)
      for (std::uint64_t x = cellOf(from.x); x <= cellOf(to.x); ++x) cells.push_back({(y << 32) | x, i});
  }
  std::sort(cells.begin(), cells.end());
  std::vector<Contact> near;
  for (std::uint32_t v = 0; v < n; ++v) {
    const DVec2 p = uv[chart_.rim[v]];
    const std::uint64_t key = (cellOf(p.y - low.y) << 32) | cellOf(p.x - low.x);
    for (auto at = std::lower_bound(cells.begin(), cells.end(), std::pair(key, 0u));
         at != cells.end() && at->first == key; ++at) {
      const std::size_t i = at->second, j = (i + 1) % n;
      if (v == i || v == j) continue;
      Contact contact{chart_.rim[v], chart_.rim[i], chart_.rim[j], reach_};
      // Neighbours along the boundary are near by nature: their reach is part of the side between.
      if ((v + n - j) % n == 1)
        contact.reach = std::min(reach_, kReach * glm::distance(p, uv[contact.to]));
      else if ((i + n - v) % n == 1)
        contact.reach = std::min(reach_, kReach * glm::distance(p, uv[contact.from]));
      if (distanceOf(p, uv[contact.from], uv[contact.to]).distance < contact.reach) near.push_back(contact);
    }
  }
  return near;
}

double SymmetricDirichlet::repulsion(const std::vector<DVec2>& uv, const std::vector<Contact>& near) const {
  double sum = 0;
  for (const Contact& c : near) {
    const double d = distanceOf(uv[c.vertex], uv[c.from], uv[c.to]).distance;
    if (d >= c.reach) continue;
    if (!(d > 0)) return kInfinite;
    const double x = c.reach / d - 1;
    sum += x * x * c.reach * c.reach;
  }
  return sum * kRepulsion / restArea_;
}

void SymmetricDirichlet::assembleRepulsion(const std::vector<DVec2>& uv, const std::vector<Contact>& near,
                                           std::vector<std::array<double, 2>>& descent) {
  for (const Contact& c : near) {
    const Near at = distanceOf(uv[c.vertex], uv[c.from], uv[c.to]);
    const double reach = c.reach, d = std::max(at.distance, 1e-6 * reach), x = reach / d - 1;
    const double first = -2 * x * reach / (d * d);
    const double second = 2 * reach * reach / (d * d * d * d) + 4 * x * reach / (d * d * d);
    const double weight = 4 * kRepulsion * reach * reach / restArea_;  // energies are over 4 here
    // The three points' shares of the gradient; three times their own blocks bound the whole Hessian.
    const std::pair<std::uint32_t, double> shares[3] = {{c.vertex, 1.0}, {c.from, at.t - 1}, {c.to, -at.t}};
    for (const auto& [vertex, share] : shares) {
      const std::uint32_t u = unknown_[vertex];
      if (u == kNowhere) continue;
      descent[u][0] -= weight * first * share * at.normal.x;
      descent[u][1] -= weight * first * share * at.normal.y;
      const double h = 3 * weight * second * share * share;
      solver_->addDiagonal(u, {h * at.normal.x * at.normal.x, h * at.normal.x * at.normal.y,
                               h * at.normal.x * at.normal.y, h * at.normal.y * at.normal.y});
    }
  }
}

double SymmetricDirichlet::step(std::vector<DVec2>& uv, Job& job) {
  const std::size_t unknowns = std::size_t(
      std::count_if(unknown_.begin(), unknown_.end(), [](std::uint32_t u) { return u != kNowhere; }));
  const double whole = energy_ >= 0 ? energy_ : energy(uv);
  energy_ = -1;
  ease(uv, job);
  const double before = isEased_ ? meanEnergy(eased_, uv) : whole;
  if (unknowns == 0) return whole;
  std::vector<std::array<double, 2>> solution(unknowns, {0.0, 0.0});
  assemble(uv, solution, job);
  std::vector<Contact> near;
  if (!fixedBoundary_) {
    double length = 0;
    for (std::size_t i = 0; i < chart_.rim.size(); ++i)
      length += glm::distance(uv[chart_.rim[i]], uv[chart_.rim[(i + 1) % chart_.rim.size()]]);
    reach_ = kReach * length / double(chart_.rim.size());
    near = contacts(uv);
    assembleRepulsion(uv, near, solution);
  }
  const double repelled = repulsion(uv, near);
  job.checkCancelled();
  const std::vector<std::array<double, 2>> descent = solution;
  double trace = 0;
  for (std::uint32_t u = 0; u < unknowns; ++u)
    trace += solver_->diagonalBlock(u)[0] + solver_->diagonalBlock(u)[3];
  // A free map may be moved and turned at no cost: a whiff of the identity decides that it is not.
  for (double shift = 1e-9 * trace / double(2 * unknowns);; shift *= 100) {
    for (std::uint32_t u = 0; u < unknowns; ++u) solver_->addDiagonal(u, {shift, 0, 0, shift});
    if (solver_->factorise(job)) break;
    if (!(shift < trace)) return whole;
  }
  solver_->solve(solution);
  job.checkCancelled();
  std::vector<DVec2> direction(uv.size(), DVec2(0));
  double decrease = 0;
  for (std::size_t v = 0; v < uv.size(); ++v)
    if (unknown_[v] != kNowhere) {
      const auto& d = solution[unknown_[v]];
      direction[v] = {d[0], d[1]};
      decrease += d[0] * descent[unknown_[v]][0] + d[1] * descent[unknown_[v]][1];
    }
  // Backtracking from the whole step, or most of the way to the first flip.
  double length = std::min(1.0, 0.95 * largestStep(uv, direction));
  std::vector<DVec2> next(uv.size());
  constexpr int kHalvings = 24;
  for (int i = 0; i < kHalvings; ++i, length *= 0.5) {
    job.checkCancelled();
    for (std::size_t v = 0; v < uv.size(); ++v) next[v] = uv[v] + direction[v] * length;
    const double after = meanEnergy(eased_, next);
    const double least = before + repelled - 1e-4 * 0.25 * length * std::max(decrease, 0.0);
    if (!(after < least)) continue;
    if (!fixedBoundary_ && !(after + repulsion(next, contacts(next)) < least)) continue;
    if (!flippedTriangles(chart_, next).empty() || (!fixedBoundary_ && !boundaryIsSimple(next))) continue;
    uv = std::move(next);
    energy_ = isEased_ ? energy(uv) : after;
    return energy_;
  }
  return whole;
}

}  // namespace prt
