#include "libprt/mesh/diagnose.h"

#include "libprt/mesh/dense_index.h"
#include "libprt/mesh/weld.h"
#include "libprt/mesh/welded_faces.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

bool finite(const DVec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Vertices, and each face on its own.
class Diagnosis {
 public:
  Diagnosis(const PolygonSoup& soup, std::span<const std::uint32_t> representative, Job& job)
      : soup_(soup), job_(job), check_(job), representative_(representative), faces_{soup} {}

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
    diagnoseSurfaces(faces_, report_, job_);
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
      faces_.placePoint(report_.duplicateVertices, std::uint32_t(v));
    }
  }

  /// Looks at each face on its own and decides whether it takes part in edges and what follows.
  void faces() {
    faces_.corners.resize(soup_.cornerCount());
    faces_.skip.assign(soup_.faceCount(), false);
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
        faces_.corners[c] = representative_[v];
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
      faces_.skip[f] = !spans;
      if (!spans) continue;
      ++faces_.solid;
      report_.triangles += soup_.face(f).size() - 2;
      for (std::uint32_t c = soup_.faceStart[f]; c < soup_.faceStart[f + 1]; ++c)
        used[faces_.corners[c]] = true;
    }
    for (std::size_t v = 0; v < referenced.size(); ++v) {
      if (referenced[v]) continue;
      report_.unreferencedVertices.add(std::uint32_t(v));
      if (finite(soup_.positions[v])) faces_.placePoint(report_.unreferencedVertices, std::uint32_t(v));
    }
    measure(used);
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
    const auto face = faces_.face(f);
    for (std::size_t i = 0; i < face.size(); ++i)
      ends.insert(ends.end(), {soup_.positions[face[i]], soup_.positions[face[(i + 1) % face.size()]]});
    defect.places.add(DefectPlaces::Edges, ends);
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

  bool threeDifferent(std::size_t f) const {
    const auto face = faces_.face(f);
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
    const auto face = faces_.face(f);
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
    std::vector<std::uint32_t> list(faces_.face(f).begin(), faces_.face(f).end());
    std::sort(list.begin(), list.end());
    return list;
  }

  /// Faces over the same positions: found by a hash that no order changes, then compared in full.
  void duplicateFaces() {
    DenseIndex<2> hashes(faces_.solid);
    std::vector<std::uint32_t> firstWith;
    for (std::uint32_t f = 0; f < faces_.skip.size(); ++f) {
      check_();
      if (faces_.skip[f]) continue;
      std::uint64_t hash = 0;
      for (std::uint32_t v : faces_.face(f)) {
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
    faces_.appendTriangles(f, corners);
    report_.duplicateFaces.places.add(DefectPlaces::Triangles, corners);
  }

  const PolygonSoup& soup_;
  Job& job_;
  CancelCheck check_;
  MeshReport report_;
  std::span<const std::uint32_t> representative_;  // [V] the vertex that stands for each
  WeldedFaces faces_;
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
