#include "ui/model/surface_patch.h"

#include "libprt/project/laid_patch.h"

#include <QPointer>

#include <algorithm>

namespace prt::ui {

SurfacePatch::SurfacePatch(Document& document, BakeController& bakes, Relighter& relighter, JobRunner& jobs,
                           QObject* parent)
    : QObject(parent), document_(document), bakes_(bakes), relighter_(relighter), jobs_(jobs) {
  connect(&bakes_, &BakeController::productArrived, this, &SurfacePatch::take);
  connect(&document_, &Document::recipeChanged, this, &SurfacePatch::followFilter);
}

void SurfacePatch::take(const QString& stage, const ProductState& state) {
  const std::vector<std::string> stages = stagesOfLaidPatch(document_.recipe());
  const bool read = std::find(stages.begin(), stages.end(), stage.toStdString()) != stages.end();
  if (read && state.level >= state.levels) makeAnew();
}

void SurfacePatch::followFilter() {
  if (document_.recipe().method.filter != filter_) makeAnew();
}

void SurfacePatch::makeAnew() {
  filter_ = document_.recipe().method.filter;
  Products products;
  products.states = bakes_.finalProducts();
  const quint64 number = ++made_;
  auto made = std::make_shared<std::shared_ptr<const BiscaleSurface>>();
  jobs_.startQuietly(
      QStringLiteral("surface patch"), tr("Patch on the surface"),
      [products, made, recipe = resolved(document_.recipe())](Job& job) {
        *made = laidPatch(products, recipe, job);
      },
      [self = QPointer(this), made, number](const JobInfo&) {
        if (self && number == self->made_) self->relighter_.setPatch(*made);
      });
}

}  // namespace prt::ui
