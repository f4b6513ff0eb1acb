#include "libprt/mesh/diagnose.h"

#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/cavity.h"
#include "libprt/mesh/dense_index.h"
#include "libprt/mesh/edges.h"
#include "libprt/mesh/weld.h"

#include <algorithm>
#include <array>
#include <map>

namespace prt {
namespace {

/// No check for cavities beyond this many triangle visits; the rest counts as inside out.
constexpr double kCavityWork = 2e8;

bool finite(const DVec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

class Diagnosis {
 public:
  Diagnosis(const PolygonSoup& soup, std::span<const std::uint32_t> representative, Job& job)
      : soup_(soup), job_(job), check_(job), representative_(representative) {}

  MeshReport run() {
    job_.begin("diagnose", 6, "steps");
    report_.vertices = soup_.positions.size();
    report_.faces = soup_.faceCount();
    vertices();
    step();
    faces();
    step();
    duplicateFaces();
    step();
    const MeshEdges edges(soup_.faceStart, corners_, skip_, job_);
    step();
    components();
    edgesAndSurfaces(edges);
    step();
    fansAndLoops(edges);
    step();
    report_.euler = long(report_.positions) - long(report_.edges) + long(solidFaces_);
    return std::move(report_);
  }

 private:
  void step() {
    job_.advance(1);
    job_.checkCancelled();
  }

  void vertices() {
    for (std::size_t v = 0; v < representative_.size(); ++v) {
      check_();
      if (!finite(soup_.positions[v])) report_.nonFiniteVertices.add(std::uint32_t(v));
      if (representative_[v] == v) continue;
      report_.duplicateVertices.add(std::uint32_t(v));
      placePoint(report_.duplicateVertices, std::uint32_t(v));
    }
  }

  /// Looks at each face on its own and decides whether it takes part in edges and what follows.
  void faces() {
    corners_.resize(soup_.cornerCount());
    skip_.assign(soup_.faceCount(), false);
    std::vector<bool> referenced(soup_.positions.size(), false), used(soup_.positions.size(), false);
    for (std::size_t f = 0; f < soup_.faceCount(); ++f) {
      check_();
      bool inRange = true, isFinite = true;
      for (std::uint32_t c = soup_.faceStart[f]; c < soup_.faceStart[f + 1]; ++c) {
        const std::uint32_t v = soup_.cornerVertex[c];
        inRange = inRange && v < soup_.positions.size();
        if (v >= soup_.positions.size()) continue;
        referenced[v] = true;
        isFinite = isFinite && finite(soup_.positions[v]);
        corners_[c] = representative_[v];
      }
      if (!inRange) report_.outOfRangeFaces.add(std::uint32_t(f));
      if (!inRange)
        placeUsableCorners(report_.outOfRangeFaces, f);
      else if (!isFinite)
        placeUsableCorners(report_.nonFiniteVertices, f);
      const bool usable = inRange && isFinite;
      const bool spans = usable && threeDifferent(f);
      if (usable && (!spans || hasNoArea(f))) {
        report_.degenerateFaces.add(std::uint32_t(f));
        placeOutline(report_.degenerateFaces, f);
      }
      skip_[f] = !spans;
      if (!spans) continue;
      ++solidFaces_;
      report_.triangles += soup_.face(f).size() - 2;
      for (std::uint32_t c = soup_.faceStart[f]; c < soup_.faceStart[f + 1]; ++c) used[corners_[c]] = true;
    }
    for (std::size_t v = 0; v < referenced.size(); ++v) {
      if (referenced[v]) continue;
      report_.unreferencedVertices.add(std::uint32_t(v));
      if (finite(soup_.positions[v])) placePoint(report_.unreferencedVertices, std::uint32_t(v));
    }
    measure(used);
  }

  void placePoint(Defect& defect, std::uint32_t v) {
    defect.places.add(DefectPlaces::Points, {&soup_.positions[v], 1});
  }

  void placeEdge(Defect& defect, std::uint32_t a, std::uint32_t b) {
    defect.places.add(DefectPlaces::Edges, std::array{soup_.positions[a], soup_.positions[b]});
  }

  void placeUsableCorners(Defect& defect, std::size_t f) {
    std::vector<DVec3> corners;
    for (const std::uint32_t v : soup_.face(f))
      if (v < soup_.positions.size() && finite(soup_.positions[v])) corners.push_back(soup_.positions[v]);
    defect.places.add(DefectPlaces::Points, corners);
  }

  void placeOutline(Defect& defect, std::size_t f) {
    if (defect.places.full()) return;
    std::vector<DVec3> ends;
    const auto face = weldedFace(f);
    for (std::size_t i = 0; i < face.size(); ++i)
      ends.insert(ends.end(), {soup_.positions[face[i]], soup_.positions[face[(i + 1) % face.size()]]});
    defect.places.add(DefectPlaces::Edges, ends);
  }

  void appendTriangles(std::uint32_t f, std::vector<DVec3>& corners) const {
    forEachTriangle(f, [&](const DVec3& a, const DVec3& b, const DVec3& c) {
      corners.insert(corners.end(), {a, b, c});
    });
  }

  void measure(const std::vector<bool>& used) {
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v]) continue;
      const DVec3& p = soup_.positions[v];
      report_.low = report_.positions == 0 ? p : min(report_.low, p);
      report_.high = report_.positions == 0 ? p : max(report_.high, p);
      ++report_.positions;
    }
  }

  std::span<const std::uint32_t> weldedFace(std::size_t f) const {
    return std::span(corners_).subspan(soup_.faceStart[f], soup_.faceStart[f + 1] - soup_.faceStart[f]);
  }

  bool threeDifferent(std::size_t f) const {
    const auto face = weldedFace(f);
    if (face.size() < 3) return false;
    const std::uint32_t a = face[0];
    std::uint32_t b = a;
    for (std::uint32_t v : face) {
      if (b == a) b = v;
      if (v != a && v != b) return true;
    }
    return false;
  }

  /// Twice the area vector of a polygon (Newell), against its longest side.
  bool hasNoArea(std::size_t f) const {
    const auto face = weldedFace(f);
    const DVec3 origin = soup_.positions[face[0]];
    DVec3 area(0);
    double longest2 = 0;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const DVec3 a = soup_.positions[face[i]] - origin;
      const DVec3 b = soup_.positions[face[(i + 1) % face.size()]] - origin;
      area += cross(a, b);
      longest2 = std::max(longest2, dot(b - a, b - a));
    }
    return !(length(area) > 1e-10 * longest2);  // also when the numbers overflow
  }

  std::vector<std::uint32_t> sortedFace(std::uint32_t f) const {
    std::vector<std::uint32_t> list(weldedFace(f).begin(), weldedFace(f).end());
    std::sort(list.begin(), list.end());
    return list;
  }

  /// Faces over the same positions: found by a hash that no order changes, then compared in full.
  void duplicateFaces() {
    DenseIndex<2> hashes(solidFaces_);
    std::vector<std::uint32_t> firstWith;
    for (std::uint32_t f = 0; f < skip_.size(); ++f) {
      check_();
      if (skip_[f]) continue;
      std::uint64_t hash = 0;
      for (std::uint32_t v : weldedFace(f)) {
        const std::uint64_t mixed = (v + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
        hash += (mixed ^ (mixed >> 31)) * 0x94d049bb133111ebu;
      }
      const std::uint32_t number = hashes.insert({std::uint32_t(hash), std::uint32_t(hash >> 32)});
      if (number == firstWith.size())
        firstWith.push_back(f);
      else if (sortedFace(f) == sortedFace(firstWith[number]))
        addDuplicateFace(f);
    }
  }

  void addDuplicateFace(std::uint32_t f) {
    report_.duplicateFaces.add(f);
    std::vector<DVec3> corners;
    appendTriangles(f, corners);
    report_.duplicateFaces.places.add(DefectPlaces::Triangles, corners);
  }

  void components() {
    UnionFind pieces(soup_.positions.size());
    for (std::size_t f = 0; f < skip_.size(); ++f) {
      check_();
      if (skip_[f]) continue;
      for (std::uint32_t v : weldedFace(f)) pieces.join(weldedFace(f)[0], v);
    }
    std::vector<bool> counted(soup_.positions.size(), false);
    for (std::size_t f = 0; f < skip_.size(); ++f) {
      if (skip_[f]) continue;
      const std::uint32_t piece = pieces.find(weldedFace(f)[0]);
      if (!counted[piece]) ++report_.components;
      counted[piece] = true;
    }
  }

  void edgesAndSurfaces(const MeshEdges& edges) {
    report_.edges = edges.size();
    std::vector<std::uint32_t> faceOfCorner(corners_.size());
    for (std::size_t f = 0; f < soup_.faceCount(); ++f)
      std::fill(faceOfCorner.begin() + soup_.faceStart[f], faceOfCorner.begin() + soup_.faceStart[f + 1],
                std::uint32_t(f));
    UnionFind surfaces(soup_.faceCount());
    std::vector<bool> open(soup_.faceCount(), false);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      check_();
      const MeshEdge edge = edges[e];
      const std::size_t count = edge.faceCount();
      for (std::uint32_t side : edge.sides) {
        surfaces.join(faceOfCorner[edge.sides[0]], faceOfCorner[side]);
        if (count % 2 == 1) open[faceOfCorner[side]] = true;
      }
      if (count == 1) ++report_.boundaryEdges;
      const bool flipped = count == 2 && corners_[edge.sides[0]] == corners_[edge.sides[1]];
      for (Defect* defect :
           {count > 2 ? &report_.nonManifoldEdges : nullptr, flipped ? &report_.flippedEdges : nullptr}) {
        if (!defect) continue;
        defect->add(edge.a);
        placeEdge(*defect, edge.a, edge.b);
      }
    }
    insideOut(surfaces, open);
  }

  /// Closed surfaces, and those of them that face inwards without being the wall of a cavity.
  void insideOut(UnionFind& surfaces, const std::vector<bool>& open) {
    std::vector<double> volume(soup_.faceCount(), 0.0), area(soup_.faceCount(), 0.0);
    std::vector<bool> closed(soup_.faceCount(), true);
    for (std::uint32_t f = 0; f < skip_.size(); ++f) {
      check_();
      if (skip_[f]) continue;
      const std::uint32_t root = surfaces.find(f);
      if (open[f]) closed[root] = false;
      const DVec3 origin = soup_.positions[weldedFace(root)[0]];
      forEachTriangle(f, [&](const DVec3& a, const DVec3& b, const DVec3& c) {
        volume[root] += dot(a - origin, cross(b - origin, c - origin));
        area[root] += length(cross(b - a, c - a));
      });
    }
    double work = 0;
    for (std::uint32_t f = 0; f < skip_.size(); ++f) {
      if (skip_[f] || surfaces.find(f) != f) continue;
      if (!closed[f]) continue;
      ++report_.closedSurfaces;
      if (volume[f] >= -1e-9 * std::pow(area[f], 1.5)) continue;  // what encloses nothing has no outside
      work += double(solidFaces_);
      if (work > kCavityWork || !insideAnother(f, surfaces, closed)) addInsideOut(f, surfaces);
    }
  }

  void addInsideOut(std::uint32_t surface, UnionFind& surfaces) {
    report_.insideOut.add(surface);
    std::vector<DVec3> corners;
    for (std::uint32_t f = 0; f < skip_.size() && corners.size() < DefectPlaces::kMost; ++f)
      if (!skip_[f] && surfaces.find(f) == surface) appendTriangles(f, corners);
    report_.insideOut.places.add(DefectPlaces::Triangles, corners);
  }

  template <class Visit>
  void forEachTriangle(std::uint32_t f, Visit visit) const {
    const auto face = weldedFace(f);
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      visit(soup_.positions[face[0]], soup_.positions[face[i]], soup_.positions[face[i + 1]]);
  }

  /// True when the other closed surfaces wind around this one.
  bool insideAnother(std::uint32_t surface, UnionFind& surfaces, const std::vector<bool>& closed) {
    const DVec3 point = soup_.positions[weldedFace(surface)[0]];
    double angle = 0;
    for (std::uint32_t f = 0; f < skip_.size(); ++f) {
      check_();
      if (skip_[f]) continue;
      const std::uint32_t root = surfaces.find(f);
      if (root == surface || !closed[root]) continue;
      forEachTriangle(f, [&](const DVec3& a, const DVec3& b, const DVec3& c) {
        angle += signedSolidAngle(point, a, b, c);
      });
    }
    return angle > 2 * kPi;
  }

  void fansAndLoops(const MeshEdges& edges) {
    std::vector<std::uint32_t> next(corners_.size());
    for (std::size_t f = 0; f < soup_.faceCount(); ++f)
      for (std::uint32_t c = soup_.faceStart[f]; c < soup_.faceStart[f + 1]; ++c)
        next[c] = c + 1 < soup_.faceStart[f + 1] ? c + 1 : soup_.faceStart[f];
    UnionFind fans = cornerFans(
        edges, corners_, [&](std::uint32_t c) { return next[c]; }, [](const MeshEdge&) { return true; },
        job_);
    nonManifoldVertices(fans);
    boundaryLoops(edges, fans, next);
  }

  void nonManifoldVertices(UnionFind& fans) {
    std::vector<std::uint32_t> fanOf(soup_.positions.size(), kNoIndex);
    std::vector<bool> several(soup_.positions.size(), false);
    for (std::size_t f = 0; f < soup_.faceCount(); ++f) {
      check_();
      if (skip_[f]) continue;
      for (std::uint32_t c = soup_.faceStart[f]; c < soup_.faceStart[f + 1]; ++c) {
        std::uint32_t& fan = fanOf[corners_[c]];
        if (fan == kNoIndex) fan = fans.find(c);
        if (fan != fans.find(c)) several[corners_[c]] = true;
      }
    }
    for (std::size_t v = 0; v < several.size(); ++v) {
      if (!several[v]) continue;
      report_.nonManifoldVertices.add(std::uint32_t(v));
      placePoint(report_.nonManifoldVertices, std::uint32_t(v));
    }
  }

  /// Boundary edges that end in one fan belong to one loop.
  void boundaryLoops(const MeshEdges& edges, UnionFind& fans, const std::vector<std::uint32_t>& next) {
    UnionFind loops(corners_.size());
    std::vector<std::uint32_t> boundary;
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (edges[e].faceCount() == 1) boundary.push_back(edges[e].sides[0]);
    for (std::uint32_t side : boundary) loops.join(fans.find(side), fans.find(next[side]));
    std::map<std::uint32_t, std::vector<DVec3>>
        edgesOf;  // the first loops', in rising order of their first side
    std::vector<std::uint32_t> order;
    std::vector<bool> counted(corners_.size(), false);
    for (std::uint32_t side : boundary) {
      const std::uint32_t loop = loops.find(fans.find(side));
      if (!counted[loop]) report_.holes.add(corners_[side]);
      if (!counted[loop] && order.size() < DefectPlaces::kMost / 6) order.push_back(loop), edgesOf[loop];
      counted[loop] = true;
      const auto kept = edgesOf.find(loop);
      if (kept == edgesOf.end() || kept->second.size() >= DefectPlaces::kMost) continue;
      kept->second.insert(kept->second.end(),
                          {soup_.positions[corners_[side]], soup_.positions[corners_[next[side]]]});
    }
    for (const std::uint32_t loop : order) report_.holes.places.add(DefectPlaces::Edges, edgesOf[loop]);
  }

  const PolygonSoup& soup_;
  Job& job_;
  CancelCheck check_;
  MeshReport report_;
  std::span<const std::uint32_t> representative_;  // [V] the vertex that stands for each
  std::vector<std::uint32_t> corners_;             // [C] representatives
  std::vector<bool> skip_;                         // [F] faces without part in topology
  std::size_t solidFaces_ = 0;
};

}  // namespace

bool MeshReport::clean() const {
  const Defect* defects[] = {&outOfRangeFaces,      &nonFiniteVertices, &degenerateFaces,     &duplicateFaces,
                             &unreferencedVertices, &nonManifoldEdges,  &nonManifoldVertices, &holes,
                             &flippedEdges,         &insideOut};
  return faces > 0 &&
         std::all_of(std::begin(defects), std::end(defects), [](const Defect* d) { return d->count == 0; });
}

MeshReport diagnose(const PolygonSoup& soup, std::span<const std::uint32_t> representative, Job& job) {
  return Diagnosis(soup, representative, job).run();
}

MeshReport diagnose(const PolygonSoup& soup, Job& job) {
  return diagnose(soup, weldByPosition(soup.positions, job), job);
}

MeshReport diagnose(const TriMesh& mesh, Job& job) {
  MeshReport report = diagnose(toSoup(mesh), job);
  report.duplicateVertices = {};
  DenseIndex<6> seen(mesh.vertexCount());
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    const Vec3& p = mesh.positions[v];
    const Vec3 n = mesh.normals.empty() ? Vec3(0) : mesh.normals[v];
    const auto known = seen.size();
    if (seen.insert({keyBits(p.x), keyBits(p.y), keyBits(p.z), keyBits(n.x), keyBits(n.y), keyBits(n.z)}) <
        known)
      report.duplicateVertices.add(v);
  }
  return report;
}

}  // namespace prt
