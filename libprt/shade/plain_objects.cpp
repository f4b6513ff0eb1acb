#include "libprt/shade/plain_objects.h"

#include "libprt/core/error.h"
#include "libprt/material/glossy_response.h"

#include <algorithm>
#include <memory>

namespace prt {
namespace {

/// Fills the texel with `number` of the table.
void addMaterial(const Material& material, int number, Rtt& table) {
  const auto functions = std::size_t(table.functions());
  std::vector<float> matte(functions), shiny(functions, 0.0f);
  lambertResponse(table.bands, Vec3(0, 0, 1), matte);
  const auto lobe =
      material.glossy() ? std::make_unique<GlossyResponse>(material.exponent, table.bands) : nullptr;
  const ViewSquare views(table.views);
  for (int view = 0; view < views.count(); ++view) {
    if (lobe) lobe->evaluate(Vec3(0, 0, 1), views.centre(view), shiny);
    float* to = table.block(number % table.texels, number / table.texels, view);
    for (std::size_t k = 0; k < functions; ++k)
      for (int c = 0; c < 3; ++c)
        *to++ = material.albedo[c] * matte[k] + (lobe ? material.specular[c] * shiny[k] : 0.0f);
  }
}

/// One texel for each object without a patch, in their order.
Rtt tableOf(const std::vector<bool>& carries, std::span<const Material> materials, int bands) {
  std::vector<const Material*> plain;
  for (std::size_t i = 0; i < materials.size(); ++i)
    if (!carries[i]) plain.push_back(&materials[i]);
  const bool glossy = std::any_of(plain.begin(), plain.end(), [](const Material* m) { return m->glossy(); });
  int side = 1;
  while (std::size_t(side) * std::size_t(side) < plain.size()) ++side;
  Rtt table(side, glossy ? PlainObjects::kViews : 1, bands, 3);
  for (std::size_t i = 0; i < plain.size(); ++i) addMaterial(*plain[i], int(i), table);
  return table;
}

std::vector<std::uint32_t> texelsOf(const Scene& scene, const std::vector<bool>& carries,
                                    std::span<const Material> materials) {
  if (carries.size() != scene.materials.size() || materials.size() != scene.materials.size())
    throw ValueError("not as many materials as objects", "objects without a patch",
                     "give one for each object");
  std::vector<std::uint32_t> ofObject;
  std::uint32_t next = 0;
  for (const bool patched : carries) ofObject.push_back(patched ? PlainObjects::kPatched : next++);
  std::vector<std::uint32_t> out;
  out.reserve(scene.triangleObject.size());
  for (const std::uint32_t object : scene.triangleObject) out.push_back(ofObject[object]);
  return out;
}

}  // namespace

PlainObjects::PlainObjects(const Scene& scene, const std::vector<bool>& carries,
                           std::span<const Material> materials, int bands)
    : texels_(texelsOf(scene, carries, materials)), responses_(tableOf(carries, materials, bands)) {}

}  // namespace prt
