#include "ui/model/synthesis_look.h"

namespace prt::ui {

namespace {

// One texel in every few.
Image pictureOf(const IdMap& map) {
  constexpr int side = SynthesisLook::kMapPixels;
  Image image(side, side, 3);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const auto at = [&](int i) { return std::size_t((2 * i + 1) * map.size / (2 * side)); };
      const std::size_t texel = at(y) * std::size_t(map.size) + at(x);
      if (map.empty(texel)) continue;
      const Vec2 u = map.at(texel);
      image.pixel(x, y)[0] = u.x, image.pixel(x, y)[1] = u.y;
    }
  return image;
}

}  // namespace

SynthesisLook::SynthesisLook(BakeController& bakes, QObject* parent) : QObject(parent) {
  connect(&bakes, &BakeController::productArrived, this, &SynthesisLook::take);
}

void SynthesisLook::forget() {
  synthesis_.reset();
  map_ = {};
  mapSize_ = 0;
  Q_EMIT changed();
}

void SynthesisLook::take(const QString& stage, const ProductState& state) {
  if (stage == u"synthesis") {
    const auto product = std::dynamic_pointer_cast<const SynthesisProduct>(state.product);
    synthesis_ = product && product->meso ? product : nullptr;
    level_ = state.level, levels_ = state.levels;
  } else if (stage == u"idmap") {
    const auto product = std::dynamic_pointer_cast<const IdMapProduct>(state.product);
    mapSize_ = product && product->map ? product->map->size : 0;
    map_ = mapSize_ ? pictureOf(*product->map) : Image();
  } else {
    return;
  }
  Q_EMIT changed();
}

}  // namespace prt::ui
