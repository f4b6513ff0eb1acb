#pragma once
// Keeps the picture's patch in step with the products: when one that the patch on the surface is made of
// arrives, it is put together anew, in the background, and handed to the relighter. Objects that carry none
// follow their materials at once.

#include "ui/model/bake_controller.h"
#include "ui/model/document.h"
#include "ui/model/relighter.h"

#include <QObject>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace prt::ui {

class SurfacePatch : public QObject {
  Q_OBJECT
 public:
  SurfacePatch(Document& document, BakeController& bakes, Relighter& relighter, JobRunner& jobs,
               QObject* parent = nullptr);

 private:
  void take(const QString& stage, const ProductState& state);
  void followRecipe();
  void makeAnew();
  /// Runs `make`, which keeps what it made, in the background.
  void start(std::function<std::shared_ptr<const BiscaleSurface>(Job&)> make);

  Document& document_;
  BakeController& bakes_;
  Relighter& relighter_;
  JobRunner& jobs_;
  bool filter_ = false;  // of the newest, like the next
  std::vector<std::optional<Material>> plain_;
  std::shared_ptr<const BiscaleSurface> whole_;  // the last one made
  bool makingAnew_ = false;
  quint64 made_ = 0;  // number of the newest: results of older ones are dropped
};

}  // namespace prt::ui
