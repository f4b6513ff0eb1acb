#include "ui/model/captured_scene.h"

#include "libprt/core/error.h"
#include "libprt/project/captured_objects.h"
#include "ui/model/scene_editor.h"
#include "ui/model/session.h"

namespace prt::ui {

CapturedScene::CapturedScene(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_.document(), &Document::recipeChanged, this, &CapturedScene::follow);
  connect(&session_, &Session::meshesChanged, this, &CapturedScene::follow);
}

void CapturedScene::follow() {
  const Recipe& recipe = session_.document().recipe();
  std::vector<Part> parts;
  std::vector<Rgb> emission;
  MeshProduct meshes;  // of the recipe's objects, which may be others than those read last
  for (std::size_t i = 0; hasCaptured(recipe) && i < recipe.objects.size(); ++i) {
    const ObjectRecipe& object = recipe.objects[i];
    const ObjectMesh found = session_.sceneEditor().meshOf(int(i));
    meshes.meshes.push_back(found ? found.product->meshes[found.index] : nullptr);
    emission.push_back(object.emission);
    if (isCaptured(object))
      parts.push_back({meshes.meshes.back(), object.transform, object.material});
    else
      parts.emplace_back();
  }
  Relighter& lit = session_.relighter();
  if (parts == parts_ && emission == emission_) return;
  if (parts == parts_) {
    lit.setEmission(emission);
  } else {
    try {
      lit.setSurroundings(surroundingsOf(recipe, meshes));
    } catch (const Error& error) {
      return session_.report(Severity::Error, QString::fromUtf8(error.what()), Place::Scene);
    }
  }
  parts_ = std::move(parts), emission_ = std::move(emission);
}

}  // namespace prt::ui
