// What the faces of a soup are together: pieces, edges, closed surfaces, fans and the loops of holes.

#include "libprt/mesh/cavity.h"
#include "libprt/mesh/edges.h"
#include "libprt/mesh/welded_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace prt {
namespace {

/// No check for cavities beyond this many triangle visits; the rest counts as inside out.
constexpr double kCavityWork = 2e8;

class SurfaceDiagnosis {
 public:
  SurfaceDiagnosis(const WeldedFaces& faces, MeshReport& report, Job& job)
      : faces_(faces), report_(report), job_(job), check_(job) {}

  void run() {
    const MeshEdges edges(faces_.soup.faceStart, faces_.corners, faces_.skip, job_);
    step();
    components();
    edgesAndSurfaces(edges);
    step();
    fansAndLoops(edges);
    step();
    report_.euler = long(report_.positions) - long(report_.edges) + long(faces_.solid);
  }

 private:
  void step() {
    job_.advance(1);
    job_.checkCancelled();
  }

  void components() {
    UnionFind pieces(faces_.soup.positions.size());
    for (std::size_t f = 0; f < faces_.skip.size(); ++f) {
      check_();
      if (faces_.skip[f]) continue;
      for (std::uint32_t v : faces_.face(f)) pieces.join(faces_.face(f)[0], v);
    }
    std::vector<bool> counted(faces_.soup.positions.size(), false);
    for (std::size_t f = 0; f < faces_.skip.size(); ++f) {
      if (faces_.skip[f]) continue;
      const std::uint32_t piece = pieces.find(faces_.face(f)[0]);
      if (!counted[piece]) ++report_.components;
      counted[piece] = true;
    }
  }

  void placeEdge(Defect& defect, std::uint32_t a, std::uint32_t b) {
    defect.places.add(DefectPlaces::Edges, std::array{faces_.soup.positions[a], faces_.soup.positions[b]});
  }

  void edgesAndSurfaces(const MeshEdges& edges) {
    report_.edges = edges.size();
    std::vector<std::uint32_t> faceOfCorner(faces_.corners.size());
    for (std::size_t f = 0; f < faces_.soup.faceCount(); ++f)
      std::fill(faceOfCorner.begin() + faces_.soup.faceStart[f],
                faceOfCorner.begin() + faces_.soup.faceStart[f + 1], std::uint32_t(f));
    UnionFind surfaces(faces_.soup.faceCount());
    std::vector<bool> open(faces_.soup.faceCount(), false);
    for (std::size_t e = 0; e < edges.size(); ++e) {
      check_();
      const MeshEdge edge = edges[e];
      const std::size_t count = edge.faceCount();
      for (std::uint32_t side : edge.sides) {
        surfaces.join(faceOfCorner[edge.sides[0]], faceOfCorner[side]);
        if (count % 2 == 1) open[faceOfCorner[side]] = true;
      }
      if (count == 1) ++report_.boundaryEdges;
      const bool flipped = count == 2 && faces_.corners[edge.sides[0]] == faces_.corners[edge.sides[1]];
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
    std::vector<double> volume(faces_.soup.faceCount(), 0.0), area(faces_.soup.faceCount(), 0.0);
    std::vector<bool> closed(faces_.soup.faceCount(), true);
    for (std::uint32_t f = 0; f < faces_.skip.size(); ++f) {
      check_();
      if (faces_.skip[f]) continue;
      const std::uint32_t root = surfaces.find(f);
      if (open[f]) closed[root] = false;
      const DVec3 origin = faces_.soup.positions[faces_.face(root)[0]];
      faces_.forEachTriangle(f, [&](const DVec3& a, const DVec3& b, const DVec3& c) {
        volume[root] += dot(a - origin, cross(b - origin, c - origin));
        area[root] += length(cross(b - a, c - a));
      });
    }
    double work = 0;
    for (std::uint32_t f = 0; f < faces_.skip.size(); ++f) {
      if (faces_.skip[f] || surfaces.find(f) != f) continue;
      if (!closed[f]) continue;
      ++report_.closedSurfaces;
      if (volume[f] >= -1e-9 * std::pow(area[f], 1.5)) continue;  // what encloses nothing has no outside
      work += double(faces_.solid);
      if (work > kCavityWork || !insideAnother(f, surfaces, closed)) addInsideOut(f, surfaces);
    }
  }

  void addInsideOut(std::uint32_t surface, UnionFind& surfaces) {
    report_.insideOut.add(surface);
    std::vector<DVec3> corners;
    for (std::uint32_t f = 0; f < faces_.skip.size() && corners.size() < DefectPlaces::kMost; ++f)
      if (!faces_.skip[f] && surfaces.find(f) == surface) faces_.appendTriangles(f, corners);
    report_.insideOut.places.add(DefectPlaces::Triangles, corners);
  }

  /// True when the other closed surfaces wind around this one.
  bool insideAnother(std::uint32_t surface, UnionFind& surfaces, const std::vector<bool>& closed) {
    const DVec3 point = faces_.soup.positions[faces_.face(surface)[0]];
    double angle = 0;
    for (std::uint32_t f = 0; f < faces_.skip.size(); ++f) {
      check_();
      if (faces_.skip[f]) continue;
      const std::uint32_t root = surfaces.find(f);
      if (root == surface || !closed[root]) continue;
      faces_.forEachTriangle(f, [&](const DVec3& a, const DVec3& b, const DVec3& c) {
        angle += signedSolidAngle(point, a, b, c);
      });
    }
    return angle > 2 * kPi;
  }

  void fansAndLoops(const MeshEdges& edges) {
    std::vector<std::uint32_t> next(faces_.corners.size());
    for (std::size_t f = 0; f < faces_.soup.faceCount(); ++f)
      for (std::uint32_t c = faces_.soup.faceStart[f]; c < faces_.soup.faceStart[f + 1]; ++c)
        next[c] = c + 1 < faces_.soup.faceStart[f + 1] ? c + 1 : faces_.soup.faceStart[f];
    UnionFind fans = cornerFans(
        edges, faces_.corners, [&](std::uint32_t c) { return next[c]; }, [](const MeshEdge&) { return true; },
        job_);
    nonManifoldVertices(fans);
    boundaryLoops(edges, fans, next);
  }

  void nonManifoldVertices(UnionFind& fans) {
    std::vector<std::uint32_t> fanOf(faces_.soup.positions.size(), kNoIndex);
    std::vector<bool> several(faces_.soup.positions.size(), false);
    for (std::size_t f = 0; f < faces_.soup.faceCount(); ++f) {
      check_();
      if (faces_.skip[f]) continue;
      for (std::uint32_t c = faces_.soup.faceStart[f]; c < faces_.soup.faceStart[f + 1]; ++c) {
        std::uint32_t& fan = fanOf[faces_.corners[c]];
        if (fan == kNoIndex) fan = fans.find(c);
        if (fan != fans.find(c)) several[faces_.corners[c]] = true;
      }
    }
    for (std::size_t v = 0; v < several.size(); ++v) {
      if (!several[v]) continue;
      report_.nonManifoldVertices.add(std::uint32_t(v));
      faces_.placePoint(report_.nonManifoldVertices, std::uint32_t(v));
    }
  }

  /// Boundary edges that end in one fan belong to one loop.
  void boundaryLoops(const MeshEdges& edges, UnionFind& fans, const std::vector<std::uint32_t>& next) {
    UnionFind loops(faces_.corners.size());
    std::vector<std::uint32_t> boundary;
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (edges[e].faceCount() == 1) boundary.push_back(edges[e].sides[0]);
    for (std::uint32_t side : boundary) loops.join(fans.find(side), fans.find(next[side]));
    std::map<std::uint32_t, std::vector<DVec3>>
        edgesOf;  // the first loops', in rising order of their first side
    std::vector<std::uint32_t> order;
    std::vector<bool> counted(faces_.corners.size(), false);
    for (std::uint32_t side : boundary) {
      const std::uint32_t loop = loops.find(fans.find(side));
      if (!counted[loop]) report_.holes.add(faces_.corners[side]);
      if (!counted[loop] && order.size() < DefectPlaces::kMost / 6) order.push_back(loop), edgesOf[loop];
      counted[loop] = true;
      const auto kept = edgesOf.find(loop);
      if (kept == edgesOf.end() || kept->second.size() >= DefectPlaces::kMost) continue;
      kept->second.insert(kept->second.end(), {faces_.soup.positions[faces_.corners[side]],
                                               faces_.soup.positions[faces_.corners[next[side]]]});
    }
    for (const std::uint32_t loop : order) report_.holes.places.add(DefectPlaces::Edges, edgesOf[loop]);
  }

  const WeldedFaces& faces_;
  MeshReport& report_;
  Job& job_;
  CancelCheck check_;
};

}  // namespace

void diagnoseSurfaces(const WeldedFaces& faces, MeshReport& report, Job& job) {
  SurfaceDiagnosis(faces, report, job).run();
}

}  // namespace prt
