#include "ui/model/scene_rays.h"

#include <QPointer>

namespace prt::ui {

SceneRays::SceneRays(Relighter& relighter, JobRunner& runner, QObject* parent)
    : QObject(parent), relighter_(relighter), runner_(runner) {
  connect(&relighter_, &Relighter::sceneChanged, this, &SceneRays::follow);
  follow();
}

void SceneRays::follow() {
  rays_.reset();
  Q_EMIT changed();
  const auto scene = relighter_.scene();
  if (!scene) return;
  auto made = std::make_shared<std::shared_ptr<const RayScene>>();
  const auto work = [scene, made](Job& job) { *made = std::make_shared<RayScene>(*scene, job); };
  const auto finish = [self = QPointer(this), scene, made](const JobInfo&) {
    if (!self || !*made || self->relighter_.scene() != scene) return;
    self->rays_ = *made;
    Q_EMIT self->changed();
  };
  runner_.startQuietly(QStringLiteral("rays"), tr("Prepare handles"), work, finish);
}

bool SceneRays::blocked(const Vec3& from, const Vec3& to) const {
  const float distance = length(to - from);
  return rays_ && distance > 0 &&
         rays_->occluded({.origin = from, .direction = (to - from) / distance, .tFar = distance});
}

}  // namespace prt::ui
