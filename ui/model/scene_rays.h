#pragma once
// Rays against the scene on screen, for handles that hide behind it. Built behind the interface whenever the
// geometry changes; until then nothing hides anything.

#include "libprt/transport/ray_scene.h"
#include "ui/model/job_runner.h"
#include "ui/model/relighter.h"

#include <QObject>

#include <memory>

namespace prt::ui {

class SceneRays : public QObject {
  Q_OBJECT
 public:
  SceneRays(Relighter& relighter, JobRunner& runner, QObject* parent = nullptr);

  /// Whether the surface lies between two points.
  bool blocked(const Vec3& from, const Vec3& to) const;
  bool ready() const { return rays_ != nullptr; }

 Q_SIGNALS:
  void changed();

 private:
  void follow();

  Relighter& relighter_;
  JobRunner& runner_;
  std::shared_ptr<const RayScene> rays_;
};

}  // namespace prt::ui
