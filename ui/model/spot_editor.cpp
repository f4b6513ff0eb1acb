#include "ui/model/spot_editor.h"

#include "libprt/core/error.h"
#include "ui/model/session.h"

#include <QPointer>

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {
constexpr float kFill = 0.45f, kHidden = 0.06f;  // opacity of spots, and behind the model
}  // namespace

SpotEditor::SpotEditor(Session& session, Brush brush, MarkOwner owner, QObject* parent)
    : QObject(parent), session_(session), brush_(brush), owner_(owner) {
  connect(&session_.document(), &Document::recipeChanged, this, &SpotEditor::follow);
  connect(&session_.painting(), &Painting::surfaceChanged, this, [this] {
    drag_.reset();
    tell();
  });
  connect(&session_.painting(), &Painting::brushChanged, this, [this] {
    if (session_.painting().brush() == brush_) setShown(true);
    if (drag_) drop();
  });
}

float SpotEditor::radius() const {
  return width_ * session_.bounds().diagonal();
}

void SpotEditor::setWidth(float width) {
  width_ = std::clamp(width, kLeastWidth, kMostWidth);
  Q_EMIT changed();
}

void SpotEditor::follow() {
  error_.clear();
  try {
    read();
  } catch (const Error& error) {
    error_ = QString::fromUtf8(error.what());
  }
  if (!drag_) show();
  Q_EMIT changed();
}

void SpotEditor::tell() {
  show();
  Q_EMIT changed();
}

// ---- painting ----

void SpotEditor::begin(const SurfaceHit& hit, bool takesAway) {
  if (!session_.painting().on() || !ready()) return;
  drag_ = Drag{takesAway, SpotTrail(radius())};
  startDrag();
  goOn(hit);
}

void SpotEditor::goOn(const SurfaceHit& hit) {
  if (!drag_) return;
  if (drag_->takesAway) {
    eraseAt(hit.position);
  } else {
    if (!drag_->trail.add(hit.position)) return;
    const auto& on = session_.painting().on();
    if (on == shapesOn_)  // no need to look for the place
      shapes_[keyOf(hit.position, radius())] =
          spotTriangles(on->surface, {hit.triangle, hit.barycentric}, radius());
    paintAt(drag_->trail.centres());
  }
  tell();
}

void SpotEditor::end() {
  if (!drag_) return;
  const bool takesAway = drag_->takesAway;
  drag_.reset();
  finishDrag(takesAway);
  tell();
}

void SpotEditor::drop() {
  drag_.reset();
  tell();
}

// ---- what is shown ----

void SpotEditor::setShown(bool shown) {
  if (shown == shown_) return;
  shown_ = shown;
  session_.painting().setNeeded(this, shown);
  tell();
}

bool SpotEditor::settled() const {
  return !shown_ || (session_.painting().on() && job_ == 0);
}

// One layer for each colour; spots of one colour do not add up where they overlap.
void SpotEditor::show() {
  const auto& on = session_.painting().on();
  if (on != shapesOn_) {
    shapesOn_ = on;
    shapes_.clear();
    ++run_;
    if (job_) session_.jobs().cancel(std::exchange(job_, 0));
  }
  if (!shown_ || !on) return session_.layers().setMarks(owner_, {});
  std::vector<SpotKey> unknown;
  std::vector<SurfaceMarks> layers;
  for (const ShownSpot& spot : spots()) {
    const SpotKey key = keyOf(spot.centre, spot.radius);
    const auto shape = shapes_.find(key);
    if (shape == shapes_.end()) {
      unknown.push_back(key);
      continue;
    }
    auto layer = std::find_if(layers.begin(), layers.end(),
                              [&](const SurfaceMarks& each) { return each.color == spot.color; });
    if (layer == layers.end()) {
      layer = layers.insert(layer, SurfaceMarks());
      layer->color = spot.color, layer->hidden = kHidden, layer->fill = kFill;
    }
    layer->triangles.insert(layer->triangles.end(), shape->second.begin(), shape->second.end());
  }
  session_.layers().setMarks(owner_, std::move(layers));
  if (!unknown.empty() && job_ == 0) findShapes(std::move(unknown));
}

// Where spots lie that were not painted just now, behind the interface.
void SpotEditor::findShapes(std::vector<SpotKey> unknown) {
  auto found = std::make_shared<Shapes>();
  const quint64 run = ++run_;
  job_ = session_.jobs().startQuietly(
      QStringLiteral("spots"), tr("Find painted spots on the surface"),
      [found, on = shapesOn_, unknown](Job& job) {
        for (const SpotKey& spot : unknown)
          (*found)[spot] = spotTriangles(
              on->surface, nearestPoint(on->surface, Vec3(spot[0], spot[1], spot[2]), job), spot[3]);
      },
      [self = QPointer(this), found, run](const JobInfo& info) {
        if (!self || run != self->run_) return;
        self->job_ = 0;
        if (info.state != JobState::Done) return;
        self->shapes_.merge(*found);
        self->tell();
      });
}

}  // namespace prt::ui
