#pragma once
// The stages that unfold the scene: charts laid flat, and the atlas that they are packed into.

#include "libprt/atlas/atlas.h"
#include "libprt/atlas/chart_settings.h"
#include "libprt/project/export.h"
#include "libprt/project/stages.h"

#include <memory>
#include <string>
#include <vector>

namespace prt {

class Pipeline;

/// Stage "charts": every chart of the scene's mesh laid flat; empty when the recipe takes over the meshes'
/// own coordinates.
struct ChartsProduct : Product {
  std::shared_ptr<const FlatCharts> charts;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// What an atlas is worth.
struct AtlasFacts {
  std::size_t charts = 0;
  double l2 = 1, lInf = 1;  ///< stretch of the whole map, 1 = isometric
  double seam = 0;          ///< length of all cuts relative to the root of the surface's area
  double filled = 0;        ///< texels covered, of all
};

/// Stage "atlas".
struct AtlasProduct : Product {
  std::shared_ptr<const Atlas> atlas;
  AtlasFacts facts;

  ProductData save() const override;
  static ProductPtr load(ProductData data);
};

/// How the recipe wants charts laid flat.
FlattenOptions flattenOptionsOf(const ChartsRecipe& charts);
/// How the recipe wants the surface cut by itself.
AutoCutOptions autoCutOptionsOf(const ChartsRecipe& charts);
/// Of an atlas for a mesh and the surface made of it.
AtlasFacts atlasFacts(const TriMesh& mesh, const Surface& surface, const Atlas& atlas, Job& job);
/// How the recipe wants charts packed; `settings` are settingsOfCharts(). Places of single charts win over
/// those of atlas.placements.
AtlasOptions packingOf(const Recipe& recipe, const Scene& scene, const FlatCharts& charts,
                       std::span<const ChartSettings> settings);

/// One line that names the chart which stretches most when charts that were cut by themselves miss
/// charts.stretch, as they may on polygons; else empty.
std::string stretchNote(const Recipe& recipe, const ChartsProduct& product);

ProductPtr makeChartsStage(StageRun& run);
ProductPtr makeAtlasStage(StageRun& run);

/// Placements set by hand, as `atlas.placements` has them: "CHART SCALE DEGREES U V" each, parted by ';',
/// charts counted from 1. Throws ValueError when the text is not of that form or names a chart that there is
/// not.
std::vector<ChartPlacement> parsePlacements(const std::string& text, std::size_t charts);
/// The reverse, of those that are locked.
std::string placementsToText(const std::vector<ChartPlacement>& placements);

/// uv, uv_faces, uv_chart and, at the atlas's size, geometry_position, geometry_normal, geometry_tangent,
/// geometry_triangle, geometry_barycentric into a folder with a manifest: an atlas without a bake.
ExportedFiles exportAtlas(const TriMesh& mesh, const AtlasProduct& atlas, const std::filesystem::path& folder,
                          Job& job);

}  // namespace prt
