#include "ui/model/defect_view.h"

#include "ui/model/scene_editor.h"
#include "ui/model/session.h"

#include <algorithm>

namespace prt::ui {

namespace {

constexpr float kSmallestFrame = 0.06f;  // a single vertex is shown with this much of the scene around it

SurfaceMarks marksOf(const DefectPlaces& places, int element, const Mat4& toScene) {
  SurfaceMarks marks;
  std::vector<Vec3>& into = places.shape == DefectPlaces::Points  ? marks.points
                            : places.shape == DefectPlaces::Edges ? marks.edges
                                                                  : marks.triangles;
  const auto chosen =
      element < 0 ? std::span<const DVec3>(places.positions) : places.element(std::size_t(element));
  for (const DVec3& p : chosen) into.push_back(Vec3(toScene * Vec4(Vec3(p), 1)));
  return marks;
}

}  // namespace

DefectView::DefectView(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_.document(), &Document::opened, this, &DefectView::hide);
  connect(&session_.document(), &Document::recipeChanged, this, &DefectView::follow);
  connect(&session_.relighter(), &Relighter::sceneChanged, this, &DefectView::follow);
}

const DefectLine* DefectView::line() const {
  if (!shown_) return nullptr;
  const ObjectMesh found = session_.sceneEditor().meshOf(shown_->object);
  if (!found) return nullptr;
  for (const DefectLine& each : found.defects())
    if (each.kind == shown_->kind) return &each;
  return nullptr;
}

int DefectView::elements() const {
  const DefectLine* found = line();
  return found ? int(found->places.elements()) : 0;
}

void DefectView::show(int object, DefectKind kind) {
  shown_ = Shown{object, kind, -1};
  if (!line()) return hide();
  apply(true);
  Q_EMIT changed();
}

void DefectView::step(int by) {
  const int count = elements();
  if (count == 0) return;
  const int next = shown_->element + by;
  shown_->element = next >= count ? -1 : (next < -1 ? count - 1 : next);
  apply(true);
  Q_EMIT changed();
}

void DefectView::hide() {
  if (!shown_) return;
  shown_.reset();
  session_.layers().setMarks(MarkOwner::Defects, {});
  Q_EMIT changed();
}

// The marks lie where the object lies now; they go with what they were about.
void DefectView::follow() {
  if (!shown_) return;
  const DefectLine* found = line();
  if (!found || shown_->element >= int(found->places.elements())) return hide();
  apply(false);
}

void DefectView::apply(bool frame) {
  const DefectPlaces& places = line()->places;
  const auto& object = session_.document().recipe().objects[std::size_t(shown_->object)];
  const SurfaceMarks marks =
      object.visible ? marksOf(places, shown_->element, object.transform.matrix()) : SurfaceMarks{};
  session_.layers().setMarks(MarkOwner::Defects, {marks});
  Box3 box = marks.bounds();
  if (!frame || box.empty()) return;
  const float missing = 0.5f * (kSmallestFrame * session_.bounds().diagonal() - box.diagonal());
  if (missing > 0) {
    box.extend(box.low - Vec3(missing));
    box.extend(box.high + Vec3(missing));
  }
  session_.view().frame(box);
}

}  // namespace prt::ui
