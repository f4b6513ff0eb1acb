#pragma once
// The lights as handles around the model: each circle light is the part of a sphere around it that the light
// covers as seen from the middle, in its colour; the middle drags it over the sphere, the rim resizes it. The
// sun and directional lights are dragged likewise. What the model hides is drawn faint.
//
// Dragged beyond the sphere's outline, a light goes on over its far side: twice the radius out is straight
// behind.

#include "ui/model/light_editor.h"
#include "ui/viewport/manipulator.h"

#include <functional>
#include <vector>

namespace prt::ui {

class SceneRays;

/// The sphere that the handles lie on: around what the camera looks at, so large that it fits into the view,
/// and no larger than the scene. Lights are infinitely far away, so that any sphere tells the same.
struct HandleSphere {
  Vec3 center{0};
  float radius = 1;
};

/// Where a line of sight meets the sphere, as a direction from its centre: on the near side, or the far one.
/// A sight that misses goes on over the edge to the other side.
Vec3 pointOnSphere(const HandleSphere& sphere, const Sight& sight, bool nearSide);

class LightHandles : public Manipulator {
  Q_OBJECT
 public:
  /// `bounds`: of the model now. `rays` says what it hides.
  LightHandles(LightEditor& lights, const SceneRays& rays, std::function<Box3()> bounds,
               QObject* parent = nullptr);

  HandleSphere sphere(const ViewGeometry& view) const;

  void paint(QPainter& painter, const ViewGeometry& view) override;
  bool hover(std::optional<QPointF> at, const ViewGeometry& view) override;
  bool press(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) override;
  void move(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) override;
  void release(const QPointF& at, const ViewGeometry& view) override;
  void cancel() override;
  bool keyPress(int key) override;
  QCursor cursor() const override;
  QString hint() const override;
  QList<Binding> bindings() const override;

 private:
  enum class Part { None, Middle, Rim };
  struct Grip {
    Part part = Part::None;
    int light = -1;
    bool operator==(const Grip&) const = default;
  };
  Grip gripAt(const QPointF& at, const ViewGeometry& view) const;
  std::vector<Vec3> rimOf(const LightMark& mark, const ViewGeometry& view) const;
  bool hidden(const Vec3& point, const ViewGeometry& view) const;
  bool onNearSide(const Vec3& direction, const ViewGeometry& view) const;
  void paintMark(QPainter& painter, const LightMark& mark, const ViewGeometry& view) const;
  void paintRim(QPainter& painter, const LightMark& mark, const ViewGeometry& view) const;

  LightEditor& lights_;
  const SceneRays& rays_;
  std::function<Box3()> bounds_;
  Grip hovered_, held_;
  LightMark atPress_;
  Vec3 grabbed_{0, 1, 0};  // the point of the sphere that was under the pointer
  bool nearSide_ = true;
};

}  // namespace prt::ui
