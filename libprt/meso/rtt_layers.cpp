#include "libprt/meso/rtt_layers.h"

#include "libprt/core/error.h"

namespace prt {

Rtt stackedRtt(std::span<const std::shared_ptr<const Rtt>> tables) {
  const Rtt& first = *tables[0];
  bool grey = true;
  for (const auto& table : tables) {
    if (table->texels != first.texels || table->views != first.views || table->bands != first.bands)
      throw ValueError("the layers' radiance transfer textures differ in size", "layers",
                       "bake them with the same section rtt");
    grey = grey && table->channels == 1 && table->colour == first.colour;
  }
  Rtt out = first;
  out.layers = int(tables.size());
  out.channels = grey ? 1 : 3;
  out.colour = grey ? first.colour : Rgb(1);
  out.values.clear();
  out.values.reserve(first.values.size() / std::size_t(first.channels) * std::size_t(out.channels) *
                     tables.size());
  for (const auto& table : tables) {
    if (grey)
      out.values.insert(out.values.end(), table->values.begin(), table->values.end());
    else
      for (std::size_t i = 0; i < table->values.size(); i += std::size_t(table->channels))
        for (std::size_t c = 0; c < 3; ++c)
          out.values.push_back(table->colour[int(c)] *
                               table->values[i + (table->channels == 3 ? c : std::size_t(0))]);
  }
  return out;
}

}  // namespace prt
