#include "ui/model/surface_patch.h"

#include "libprt/project/laid_patch.h"

#include <QPointer>

#include <algorithm>

namespace prt::ui {

SurfacePatch::SurfacePatch(Document& document, BakeController& bakes, Relighter& relighter, JobRunner& jobs,
                           QObject* parent)
    : QObject(parent), document_(document), bakes_(bakes), relighter_(relighter), jobs_(jobs) {
  connect(&bakes_, &BakeController::productArrived, this, &SurfacePatch::take);
  connect(&document_, &Document::recipeChanged, this, &SurfacePatch::followRecipe);
}

void SurfacePatch::take(const QString& stage, const ProductState& state) {
  const std::vector<std::string> stages = stagesOfLaidPatch(document_.recipe());
  const bool read = std::find(stages.begin(), stages.end(), stage.toStdString()) != stages.end();
  if (read && state.level >= state.levels) makeAnew();
}

void SurfacePatch::followRecipe() {
  const Recipe& recipe = document_.recipe();
  if (recipe.method.filter != filter_) return makeAnew();
  std::vector<std::optional<Material>> plain = plainMaterials(recipe);
  if (plain == plain_) return;
  // A patch that is being put together is begun anew: it may be one of newer products.
  if (makingAnew_ || !whole_) return makeAnew();
  plain_ = std::move(plain);
  start([whole = whole_, recipe = resolved(recipe)](Job&) { return withPlainObjects(whole, recipe); });
}

void SurfacePatch::makeAnew() {
  const Recipe recipe = resolved(document_.recipe());
  filter_ = recipe.method.filter;
  plain_ = plainMaterials(document_.recipe());
  Products products;
  products.states = bakes_.finalProducts();
  start([products, recipe](Job& job) { return laidPatch(products, recipe, job); });
  makingAnew_ = true;
}

void SurfacePatch::start(std::function<std::shared_ptr<const BiscaleSurface>(Job&)> make) {
  const quint64 number = ++made_;
  auto made = std::make_shared<std::shared_ptr<const BiscaleSurface>>();
  jobs_.startQuietly(
      QStringLiteral("surface patch"), tr("Patch on the surface"),
      [make = std::move(make), made](Job& job) { *made = make(job); },
      [self = QPointer(this), made, number](const JobInfo&) {
        if (!self || number != self->made_) return;
        self->makingAnew_ = false;
        self->whole_ = *made;
        self->relighter_.setPatch(*made);
      });
}

}  // namespace prt::ui
