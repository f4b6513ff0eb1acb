#include "libprt/mesh/defect_list.h"

#include <algorithm>
#include <array>

namespace prt {
namespace {

struct KindFacts {
  const char* key;
  const char* singular;
  const char* plural;
  Defect MeshReport::*member;
  const char* mended;  ///< what became of them when none is left
  const char* meaning;
};

constexpr std::array<KindFacts, kDefectKinds> kFacts{{
    {"out_of_range_faces", "face with an index out of range", "faces with an index out of range",
     &MeshReport::outOfRangeFaces, "dropped",
     "Corners that the file does not hold: these faces are gone. Export the mesh again."},
    {"non_finite_vertices", "non-finite vertex", "non-finite vertices", &MeshReport::nonFiniteVertices,
     "dropped", "Coordinates that are no numbers: the faces that use them are gone. Export the mesh again."},
    {"degenerate_faces", "degenerate face", "degenerate faces", &MeshReport::degenerateFaces, "dropped",
     "Faces without area: nothing can be seen of them and nothing is lost."},
    {"duplicate_faces", "duplicate face", "duplicate faces", &MeshReport::duplicateFaces, "dropped",
     "The same face more than once: one is enough, and two back to back shadow each other."},
    {"duplicate_vertices", "duplicate vertex", "duplicate vertices", &MeshReport::duplicateVertices, "welded",
     "Vertices at one position: welded where their normals agree; the others make creases."},
    {"unreferenced_vertices", "unreferenced vertex", "unreferenced vertices",
     &MeshReport::unreferencedVertices, "removed", "Vertices of no face: they would be baked for nothing."},
    {"non_manifold_edges", "non-manifold edge", "non-manifold edges", &MeshReport::nonManifoldEdges, "split",
     "More than two faces meet in an edge: shading and shadows may leak across it. Split non-manifold parts "
     "it."},
    {"non_manifold_vertices", "non-manifold vertex", "non-manifold vertices",
     &MeshReport::nonManifoldVertices, "split",
     "Fans of faces that touch in one vertex only share its light. Split non-manifold parts them."},
    {"holes", "hole", "holes", &MeshReport::holes, "closed",
     "Open borders: meant in sheets and scans; in a solid, light comes in and back faces show black."},
    {"flipped_edges", "edge between faces wound against each other",
     "edges between faces wound against each other", &MeshReport::flippedEdges, "turned",
     "Neighbours that face opposite ways: one of them is black. Set the orientation to consistent or "
     "outward."},
    {"inside_out", "inside-out closed surface", "inside-out closed surfaces", &MeshReport::insideOut,
     "turned", "A solid that faces inwards bakes black. Set the orientation to outward."},
}};

const KindFacts& factsOf(DefectKind kind) {
  return kFacts[std::size_t(kind)];
}

/// Lost with the faces that had them, not put right.
bool isLoss(DefectKind kind) {
  return kind == DefectKind::OutOfRangeFaces || kind == DefectKind::NonFiniteVertices;
}

bool isOftenMeant(DefectKind kind) {
  return kind == DefectKind::Holes || kind == DefectKind::DuplicateVertices ||
         kind == DefectKind::UnreferencedVertices || kind == DefectKind::NonManifoldVertices;
}

/// Places in the repaired mesh's frame; without those that a mesh could not have.
DefectPlaces moved(const DefectPlaces& places, const DVec3& by) {
  constexpr double kFarthest = 1e9;
  DefectPlaces out;
  std::vector<DVec3> element;
  for (std::size_t i = 0; i < places.elements(); ++i) {
    element.assign(places.element(i).begin(), places.element(i).end());
    double farthest = 0;
    for (DVec3& p : element)
      p += by, farthest = std::max({farthest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (farthest <= kFarthest) out.add(places.shape, element);
  }
  return out;
}

}  // namespace

std::string groupedDigits(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

const Defect& defectOf(const MeshReport& report, DefectKind kind) {
  return report.*factsOf(kind).member;
}

const char* defectKey(DefectKind kind) {
  return factsOf(kind).key;
}

std::optional<DefectKind> defectKind(std::string_view key) {
  for (std::size_t i = 0; i < kFacts.size(); ++i)
    if (key == kFacts[i].key) return DefectKind(i);
  return {};
}

std::string defectName(DefectKind kind, std::size_t count) {
  return groupedDigits(count) + " " + (count == 1 ? factsOf(kind).singular : factsOf(kind).plural);
}

const char* defectMeaning(DefectKind kind) {
  return factsOf(kind).meaning;
}

DefectSeverity DefectLine::severity() const {
  if (left == 0) return isLoss(kind) ? DefectSeverity::Warning : DefectSeverity::Mended;
  return isOftenMeant(kind) ? DefectSeverity::Harmless : DefectSeverity::Warning;
}

std::string DefectLine::outcome() const {
  if (left == 0) return factsOf(kind).mended;
  if (kind == DefectKind::Holes) return "left open";
  if (kind == DefectKind::DuplicateVertices) return left == found ? "kept" : groupedDigits(left) + " kept";
  return left >= found ? "left" : groupedDigits(left) + " left";
}

std::vector<DefectLine> defectLines(const RepairReport& report) {
  std::vector<DefectLine> lines;
  for (int i = 0; i < kDefectKinds; ++i) {
    const auto kind = DefectKind(i);
    const Defect &before = defectOf(report.before, kind), &after = defectOf(report.after, kind);
    DefectLine line{kind, before.count, after.count, {}};
    // A repaired mesh lists none: what is doubled there makes a crease.
    if (kind == DefectKind::DuplicateVertices)
      line.left = before.count - std::min(before.count, report.weldedVertices);
    if (line.found == 0 && line.left == 0) continue;
    line.places = after.count > 0 ? moved(after.places, DVec3(0)) : moved(before.places, -report.offset);
    lines.push_back(std::move(line));
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const DefectLine& a, const DefectLine& b) { return a.severity() > b.severity(); });
  return lines;
}

}  // namespace prt
