// Reports as one line of text and as JSON.

#include "libprt/mesh/defect_list.h"

#include <nlohmann/json.hpp>

namespace prt {
namespace {

using Json = nlohmann::json;

/// "1 hole", "2 holes"; the plural of "vertex" is "vertices".
std::string counted(std::size_t number, const std::string& singular, const std::string& plural = {}) {
  const std::string many = plural.empty() ? singular + "s" : plural;
  return groupedDigits(number) + " " + (number == 1 ? singular : many);
}

void list(std::string& text, const std::string& item) {
  text.append(text.empty() ? "" : ", ").append(item);
}

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

std::string factsText(const MeshReport& report) {
  std::string facts;
  list(facts, counted(report.vertices, "vertex", "vertices"));
  list(facts, counted(report.faces, "face"));
  list(facts, counted(report.components, "component"));
  return facts + (report.closed() ? ", closed" : ", open");
}

std::string toText(const MeshReport& report) {
  std::string defects;
  for (int i = 0; i < kDefectKinds; ++i) {
    const std::size_t count = defectOf(report, DefectKind(i)).count;
    if (count == 0) continue;
    list(defects, defectName(DefectKind(i), count));
    if (DefectKind(i) == DefectKind::Holes)
      defects.append(" (").append(counted(report.boundaryEdges, "boundary edge")).append(")");
  }
  return factsText(report).append("; ").append(defects.empty() ? "no defects" : defects);
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
  for (int i = 0; i < kDefectKinds; ++i) {
    const Defect& defect = defectOf(report, DefectKind(i));
    defects[defectKey(DefectKind(i))] = {{"count", defect.count}, {"first", defect.first}};
  }
  return json;
}

bool RepairReport::changedAnything() const {
  for (const NamedCount& action : kActions)
    if (this->*action.member > 0) return true;
  return offset != DVec3(0);
}

std::vector<std::string> repairActions(const RepairReport& report) {
  std::vector<std::string> actions;
  for (const NamedCount& action : kActions) {
    const std::size_t count = report.*action.member;
    if (count > 0)
      actions.push_back(
          std::string(action.done).append(" ").append(counted(count, action.singular, action.plural)));
  }
  if (report.offset != DVec3(0)) actions.emplace_back("moved to the origin to keep precision");
  return actions;
}

std::string toText(const RepairReport& report) {
  std::string text;
  for (const std::string& action : repairActions(report)) list(text, action);
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
