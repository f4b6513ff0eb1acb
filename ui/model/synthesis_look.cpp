#include "ui/model/synthesis_look.h"

#include "libprt/project/export_synthesis.h"

namespace prt::ui {

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
    map_ = mapSize_ ? idMapPicture(*product->map, kMapPixels) : Image();
  } else {
    return;
  }
  Q_EMIT changed();
}

}  // namespace prt::ui
