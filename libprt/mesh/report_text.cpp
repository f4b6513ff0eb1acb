// Reports as one line of text and as JSON.

#include "libprt/mesh/repair.h"

#include <nlohmann/json.hpp>

namespace prt {
namespace {

using Json = nlohmann::json;

/// 1234567 -> "1,234,567".
std::string grouped(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, 1, ',');
  return digits;
}

/// "1 hole", "2 holes"; the plural of "vertex" is "vertices".
std::string counted(std::size_t number, const std::string& singular, const std::string& plural = {}) {
  const std::string many = plural.empty() ? singular + "s" : plural;
  return grouped(number) + " " + (number == 1 ? singular : many);
}

void list(std::string& text, const std::string& item) {
  text.append(text.empty() ? "" : ", ").append(item);
}

struct NamedDefect {
  const char* key;
  const char* singular;
  const char* plural;
  Defect MeshReport::*member;
};

constexpr NamedDefect kDefects[] = {
    {"out_of_range_faces", "face with an index out of range", "faces with an index out of range",
     &MeshReport::outOfRangeFaces},
    {"non_finite_vertices", "non-finite vertex", "non-finite vertices", &MeshReport::nonFiniteVertices},
    {"degenerate_faces", "degenerate face", "degenerate faces", &MeshReport::degenerateFaces},
    {"duplicate_faces", "duplicate face", "duplicate faces", &MeshReport::duplicateFaces},
    {"duplicate_vertices", "duplicate vertex", "duplicate vertices", &MeshReport::duplicateVertices},
    {"unreferenced_vertices", "unreferenced vertex", "unreferenced vertices",
     &MeshReport::unreferencedVertices},
    {"non_manifold_edges", "non-manifold edge", "non-manifold edges", &MeshReport::nonManifoldEdges},
    {"non_manifold_vertices", "non-manifold vertex", "non-manifold vertices",
     &MeshReport::nonManifoldVertices},
    {"holes", "hole", "holes", &MeshReport::holes},
    {"flipped_edges", "edge between faces wound against each other",
     "edges between faces wound against each other", &MeshReport::flippedEdges},
    {"inside_out", "inside-out closed surface", "inside-out closed surfaces", &MeshReport::insideOut},
};

Json vectorJson(const DVec3& v) {
  return {v.x, v.y, v.z};
}

struct NamedCount {
  const char* key;
  const char* done;  ///< "dropped", before the counted thing
  const char* singular;
  const char* plural;
  std::size_t RepairReport::*member;
};

constexpr NamedCount kActions[] = {
    {"welded_vertices", "welded", "vertex", "vertices", &RepairReport::weldedVertices},
    {"removed_vertices", "removed", "unused vertex", "unused vertices", &RepairReport::removedVertices},
    {"dropped_out_of_range", "dropped", "face with an index out of range", "faces with an index out of range",
     &RepairReport::droppedOutOfRange},
    {"dropped_non_finite", "dropped", "face with a non-finite vertex", "faces with a non-finite vertex",
     &RepairReport::droppedNonFinite},
    {"dropped_degenerate", "dropped", "degenerate face", "degenerate faces",
     &RepairReport::droppedDegenerate},
    {"dropped_duplicates", "dropped", "duplicate face", "duplicate faces", &RepairReport::droppedDuplicates},
    {"cut_polygons", "cut up", "polygon", "polygons", &RepairReport::cutPolygons},
    {"flipped_triangles", "flipped", "triangle", "triangles", &RepairReport::flippedTriangles},
    {"split_vertices", "split", "non-manifold vertex", "non-manifold vertices", &RepairReport::splitVertices},
    {"filled_uvs", "set", "missing texture coordinate to (0, 0)", "missing texture coordinates to (0, 0)",
     &RepairReport::filledUvs},
};

}  // namespace

std::string toText(const MeshReport& report) {
  std::string facts;
  list(facts, counted(report.vertices, "vertex", "vertices"));
  list(facts, counted(report.faces, "face"));
  list(facts, counted(report.components, "component"));
  facts += report.closed() ? ", closed" : ", open";
  std::string defects;
  for (const NamedDefect& d : kDefects) {
    const std::size_t count = (report.*d.member).count;
    if (count == 0) continue;
    list(defects, counted(count, d.singular, d.plural));
    if (d.member == &MeshReport::holes)
      defects.append(" (").append(counted(report.boundaryEdges, "boundary edge")).append(")");
  }
  return facts.append("; ").append(defects.empty() ? "no defects" : defects);
}

nlohmann::json toJson(const MeshReport& report) {
  Json json{{"vertices", report.vertices},
            {"faces", report.faces},
            {"triangles", report.triangles},
            {"positions", report.positions},
            {"edges", report.edges},
            {"boundary_edges", report.boundaryEdges},
            {"components", report.components},
            {"closed_surfaces", report.closedSurfaces},
            {"closed", report.closed()},
            {"euler", report.euler},
            {"bounds", {{"low", vectorJson(report.low)}, {"high", vectorJson(report.high)}}}};
  Json& defects = json["defects"] = Json::object();
  for (const NamedDefect& d : kDefects) {
    const Defect& defect = report.*d.member;
    defects[d.key] = {{"count", defect.count}, {"first", defect.first}};
  }
  return json;
}

bool RepairReport::changedAnything() const {
  for (const NamedCount& action : kActions)
    if (this->*action.member > 0) return true;
  return offset != DVec3(0);
}

std::string toText(const RepairReport& report) {
  std::string text;
  for (const NamedCount& action : kActions) {
    const std::size_t count = report.*action.member;
    if (count > 0)
      list(text, std::string(action.done).append(" ").append(counted(count, action.singular, action.plural)));
  }
  if (report.offset != DVec3(0)) list(text, "moved to the origin to keep precision");
  return text.empty() ? "nothing to repair" : text;
}

nlohmann::json toJson(const RepairReport& report) {
  Json json{{"before", toJson(report.before)},
            {"after", toJson(report.after)},
            {"offset", vectorJson(report.offset)},
            {"crease_vertices", report.creaseVertices},
            {"kept_normals", report.keptNormals},
            {"computed_normals", report.computedNormals},
            {"unit", report.unit},
            {"notes", report.notes}};
  for (const NamedCount& action : kActions) json[action.key] = report.*action.member;
  return json;
}

}  // namespace prt
