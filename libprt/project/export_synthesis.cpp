#include "libprt/project/export_synthesis.h"

#include <algorithm>

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
  if (map.layers == 0) return;
  std::vector<float> weights(map.weights.size());
  std::transform(map.weights.begin(), map.weights.end(), weights.begin(),
                 [](std::uint8_t w) { return float(w) / 255.0f; });
  write("idmap_layers", Array::from<float>(std::span<const float>(weights), {map.size, map.size, map.layers}),
        "what of each texel the layers over the patch show; the patch shows the rest");
}

Image idMapPicture(const IdMap& map, int side) {
  if (side <= 0) side = map.size;
  Image picture(side, side, 3);
  const auto at = [&](int i) { return std::size_t((2 * std::int64_t(i) + 1) * map.size / (2 * side)); };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      if (const Vec2 u = map.at(at(y) * std::size_t(map.size) + at(x)); u.x >= 0)
        picture.pixel(x, y)[0] = u.x, picture.pixel(x, y)[1] = u.y;
  return picture;
}

}  // namespace prt
