#include "libprt/project/export_synthesis.h"

namespace prt {
namespace {

template <class V>
Array rows(const std::vector<V>& vectors) {
  return Array::from<float>(std::span(&vectors[0][0], vectors.size() * std::size_t(V::length())),
                            {std::int64_t(vectors.size()), V::length()});
}

}  // namespace

void writeMesoArrays(const SynthesisProduct& synthesis, const WriteArray& write) {
  write("meso_positions", rows(synthesis.meso->positions), "vertices of the meso mesh, on the surface");
  write("meso_normals", rows(synthesis.meso->normals), "their unit shading normals");
  write("meso_patch", rows(*synthesis.coordinates), "their patch coordinates, in [0, 1)");
}

void writeIdMapArray(const IdMap& map, const WriteArray& write) {
  std::vector<float> values(map.ids.size());
  for (std::size_t i = 0; 2 * i < map.ids.size(); ++i) {
    const Vec2 u = map.at(i);
    values[2 * i] = u.x, values[2 * i + 1] = u.y;
  }
  write("idmap", Array::from<float>(std::span<const float>(values), {map.size, map.size, 2}),
        "patch coordinates of each texel, rows from the top, in steps of 1/65535; -1 where there is no "
        "surface");
}

Image idMapPicture(const IdMap& map) {
  Image picture(map.size, map.size, 3);
  for (std::size_t i = 0; i < picture.pixels(); ++i)
    if (const Vec2 u = map.at(i); u.x >= 0) picture.data[3 * i] = u.x, picture.data[3 * i + 1] = u.y;
  return picture;
}

}  // namespace prt
