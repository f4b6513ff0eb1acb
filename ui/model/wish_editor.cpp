#include "ui/model/wish_editor.h"

#include "libprt/core/error.h"
#include "libprt/project/synthesis_stages.h"
#include "ui/model/session.h"

#include <QPointer>

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {
constexpr float kFill = 0.45f, kHidden = 0.06f;  // opacity of spots, and behind the model
}  // namespace

WishEditor::WishEditor(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_.document(), &Document::recipeChanged, this, &WishEditor::follow);
  connect(&session_.painting(), &Painting::surfaceChanged, this, [this] {
    drag_.reset();
    show();
    Q_EMIT changed();
  });
  connect(&session_.painting(), &Painting::brushChanged, this, [this] {
    if (session_.painting().brush() == Brush::Wishes) setShown(true);
    if (drag_) drop();
  });
}

float WishEditor::radius() const {
  return width_ * session_.bounds().diagonal();
}

void WishEditor::setPart(const Vec2& place, float extent) {
  place_ = place - glm::floor(place);
  extent_ = std::clamp(extent, kLeastExtent, kMostExtent);
  Q_EMIT changed();
}

void WishEditor::setWidth(float width) {
  width_ = std::clamp(width, kLeastWidth, kMostWidth);
  Q_EMIT changed();
}

void WishEditor::follow() {
  error_.clear();
  try {
    wishes_ = parseWishes(session_.document().recipe().synthesis.wishes);
  } catch (const Error& error) {
    wishes_.clear();
    error_ = QString::fromUtf8(error.what());
  }
  if (!drag_) show();
  Q_EMIT changed();
}

// ---- painting ----

void WishEditor::begin(const SurfaceHit& hit, bool takesAway) {
  if (!session_.painting().on()) return;
  drag_ = Drag{takesAway, WishTrail({.radius = radius(), .place = place_, .extent = extent_})};
  dragged_ = wishes_;
  goOn(hit);
}

void WishEditor::goOn(const SurfaceHit& hit) {
  if (!drag_) return;
  if (drag_->takesAway) {
    dragged_ = erasedAround(dragged_, hit.position, radius());
  } else {
    if (!drag_->trail.add(hit.position)) return;
    const PatchWish& spot = drag_->trail.spots().back();
    const auto& on = session_.painting().on();
    if (on == shapesOn_)  // no need to look for the place
      shapes_[keyOf(spot)] = spotTriangles(on->surface, {hit.triangle, hit.barycentric}, spot.radius);
    dragged_ = paintedOver(wishes_, drag_->trail.spots());
  }
  show();
  Q_EMIT changed();
}

void WishEditor::end() {
  if (!drag_) return;
  const bool takesAway = drag_->takesAway;
  drag_.reset();
  Recipe next = session_.document().recipe();
  next.synthesis.wishes = wishesToText(dragged_);
  session_.document().edit(takesAway ? tr("Erase wishes") : tr("Paint wish"), next);
  show();
  Q_EMIT changed();
}

void WishEditor::drop() {
  drag_.reset();
  show();
  Q_EMIT changed();
}

void WishEditor::eraseAll() {
  Recipe next = session_.document().recipe();
  next.synthesis.wishes.clear();
  session_.document().edit(tr("Erase all wishes"), next);
}

// ---- what is shown ----

void WishEditor::setShown(bool shown) {
  if (shown == shown_) return;
  shown_ = shown;
  session_.painting().setNeeded(this, shown);
  show();
  Q_EMIT changed();
}

bool WishEditor::settled() const {
  return !shown_ || (session_.painting().on() && job_ == 0);
}

// One layer for each colour; spots of one colour do not add up where they overlap.
void WishEditor::show() {
  const auto& on = session_.painting().on();
  if (on != shapesOn_) {
    shapesOn_ = on;
    shapes_.clear();
    ++run_;
    if (job_) session_.jobs().cancel(std::exchange(job_, 0));
  }
  if (!shown_ || !on) return session_.layers().setMarks(MarkOwner::Wishes, {});
  std::vector<PatchWish> unknown;
  std::vector<SurfaceMarks> layers;
  for (const PatchWish& wish : wishes()) {
    const auto shape = shapes_.find(keyOf(wish));
    if (shape == shapes_.end()) {
      unknown.push_back(wish);
      continue;
    }
    const Rgb color = colorOfPart(wish.place);
    auto layer = std::find_if(layers.begin(), layers.end(),
                              [&](const SurfaceMarks& each) { return each.color == color; });
    if (layer == layers.end()) {
      layer = layers.insert(layer, SurfaceMarks());
      layer->color = color, layer->hidden = kHidden, layer->fill = kFill;
    }
    layer->triangles.insert(layer->triangles.end(), shape->second.begin(), shape->second.end());
  }
  session_.layers().setMarks(MarkOwner::Wishes, std::move(layers));
  if (!unknown.empty() && job_ == 0) findShapes(std::move(unknown));
}

// Where wishes lie that were not painted just now, behind the interface.
void WishEditor::findShapes(std::vector<PatchWish> unknown) {
  auto found = std::make_shared<Shapes>();
  const quint64 run = ++run_;
  job_ = session_.jobs().startQuietly(
      QStringLiteral("wishes"), tr("Find wishes on the surface"),
      [found, on = shapesOn_, unknown](Job& job) {
        for (const PatchWish& wish : unknown)
          (*found)[keyOf(wish)] =
              spotTriangles(on->surface, nearestPoint(on->surface, wish.centre, job), wish.radius);
      },
      [self = QPointer(this), found, run](const JobInfo& info) {
        if (!self || run != self->run_) return;
        self->job_ = 0;
        if (info.state != JobState::Done) return;
        self->shapes_.merge(*found);
        self->show();
        Q_EMIT self->changed();
      });
}

}  // namespace prt::ui
