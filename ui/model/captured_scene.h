#pragma once
// Keeps the objects that stand around the model in step with the recipe: whatever of them is edited is in the
// next frame, without a bake.

#include "libprt/project/products.h"
#include "libprt/project/recipe.h"

#include <QObject>

#include <memory>
#include <utility>
#include <vector>

namespace prt::ui {

class Session;

class CapturedScene : public QObject {
  Q_OBJECT
 public:
  explicit CapturedScene(Session& session, QObject* parent = nullptr);

 private:
  /// What a captured object is made from; null mesh: not read yet.
  struct Part {
    std::shared_ptr<const TriMesh> mesh;
    TransformRecipe transform;
    Material material;
    bool operator==(const Part&) const = default;
  };

  void follow();

  Session& session_;
  std::vector<Part> parts_;  // of what is shown: [objects], empty where there is none
  std::vector<Rgb> emission_;
};

}  // namespace prt::ui
