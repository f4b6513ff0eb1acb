#pragma once
// What is known of the patch laid over the surface: how good the synthesis is, and a picture of the id map.

#include "libprt/core/image.h"
#include "libprt/project/synthesis_stages.h"
#include "ui/model/bake_controller.h"

#include <QObject>

#include <memory>

namespace prt::ui {

class SynthesisLook : public QObject {
  Q_OBJECT
 public:
  explicit SynthesisLook(BakeController& bakes, QObject* parent = nullptr);

  /// Another document: nothing is known of it yet.
  void forget();
  /// Null while there is none; a preview holds the first levels of the mesh.
  const std::shared_ptr<const SynthesisProduct>& synthesis() const { return synthesis_; }
  /// Levels of the mesh that are done and wanted; equal when it is final.
  int level() const { return level_; }
  int levels() const { return levels_; }
  /// Place in the patch of every texel, u in red, v in green, black where empty; sRGB values, kMapPixels a
  /// side. Empty without an id map.
  const Image& map() const { return map_; }
  int mapSize() const { return mapSize_; }

  static constexpr int kMapPixels = 256;

 Q_SIGNALS:
  void changed();

 private:
  void take(const QString& stage, const ProductState& state);

  std::shared_ptr<const SynthesisProduct> synthesis_;
  int level_ = 0, levels_ = 0, mapSize_ = 0;
  Image map_;
};

}  // namespace prt::ui
