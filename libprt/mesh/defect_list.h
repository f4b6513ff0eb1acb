#pragma once
// The import report as a list: one line for each class of defects that a file had or a repaired mesh still
// has, with what became of it, what it means for a bake, and where it is.

#include "libprt/mesh/repair.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace prt {

/// In the order of MeshReport's members.
enum class DefectKind {
  OutOfRangeFaces,
  NonFiniteVertices,
  DegenerateFaces,
  DuplicateFaces,
  DuplicateVertices,
  UnreferencedVertices,
  NonManifoldEdges,
  NonManifoldVertices,
  Holes,
  FlippedEdges,
  InsideOut
};
inline constexpr int kDefectKinds = 11;

const Defect& defectOf(const MeshReport& report, DefectKind kind);
/// "non_manifold_edges": the name in JSON and project files.
const char* defectKey(DefectKind kind);
std::optional<DefectKind> defectKind(std::string_view key);
/// "1 hole", "1,204 holes".
std::string defectName(DefectKind kind, std::size_t count);
/// What it does to a bake and what helps, one line.
const char* defectMeaning(DefectKind kind);

/// How much a line matters, least first.
enum class DefectSeverity {
  Mended,    ///< repaired without loss
  Harmless,  ///< still there, and often meant: holes, doubled vertices
  Warning    ///< still there and shows in a bake, or part of the file was lost
};

struct DefectLine {
  DefectKind kind = DefectKind::Holes;
  std::size_t found = 0;  ///< in the file
  std::size_t left = 0;   ///< in the repaired mesh
  /// In the frame of the repaired mesh: of those that are left, or where they were when none is.
  DefectPlaces places;

  DefectSeverity severity() const;
  /// What became of it: "welded", "dropped", "3 left", "left open".
  std::string outcome() const;
};

/// Lines of the classes that occur, most severe first.
std::vector<DefectLine> defectLines(const RepairReport& report);

/// What the repair did, one phrase each: "welded 403 vertices", "moved to the origin to keep precision".
std::vector<std::string> repairActions(const RepairReport& report);
/// "36,000 vertices, 69,451 faces, 1 component, open".
std::string factsText(const MeshReport& report);

/// 1234567 -> "1,234,567".
std::string groupedDigits(std::size_t number);

}  // namespace prt
