#pragma once
// Cuts and settings of charts by hand: the recipe keeps them per object, by the numbers of the object's own
// mesh; surfaces and charts are those of the whole scene.

#include "libprt/atlas/chart_settings.h"
#include "libprt/project/recipe.h"
#include "libprt/transport/scene.h"

#include <string>
#include <vector>

namespace prt {

/// objects[].seams over the scene's surface. Hidden objects have none. Throws ValueError, which names the
/// object, when its mesh has no such vertex or edge.
Seams drawnSeams(const Recipe& recipe, const Scene& scene, const Surface& surface);
/// The reverse for one object.
std::string seamsOfObject(const Scene& scene, const Surface& surface, const Seams& seams, std::size_t object);

/// objects[].charts with the triangles of the scene. Throws ValueError, which names the object.
std::vector<ChartSettings> chartSettingsOf(const Recipe& recipe, const Scene& scene);
/// Writes settings by triangles of the scene into the objects that these belong to; hidden objects keep
/// theirs.
void setChartSettings(Recipe& recipe, const Scene& scene, std::span<const ChartSettings> settings);

/// What of objects[].charts the flat maps depend on.
std::string cornersText(const Recipe& recipe);

}  // namespace prt
