#include "ui/model/field_editor.h"

#include "libprt/core/error.h"
#include "libprt/project/synthesis_stages.h"
#include "ui/model/session.h"

#include <QPointer>

#include <algorithm>
#include <utility>

namespace prt::ui {

struct FieldEditor::Made {
  std::shared_ptr<const OrientationField> field;
  SurfaceMarks lines;
  std::vector<FieldKnot> knots;
};

FieldEditor::FieldEditor(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_.document(), &Document::opened, this, &FieldEditor::forget);
  connect(&session_.document(), &Document::recipeChanged, this, &FieldEditor::follow);
  connect(&session_.painting(), &Painting::surfaceChanged, this, [this] {
    path_.reset();
    follow();
  });
  connect(&session_.painting(), &Painting::brushChanged, this, [this] {
    if (session_.painting().brush() == Brush::Strokes) setShown(true);
    path_.reset();
    selected_ = -1;
    Q_EMIT changed();
  });
}

float FieldEditor::width() const {
  return session_.document().recipe().field.width * session_.bounds().diagonal();
}

// ---- reading ----

void FieldEditor::forget() {
  path_.reset();
  selected_ = -1;
  hideField();
}

void FieldEditor::follow() {
  const std::size_t before = strokes_.size();
  strokesError_.clear();
  try {
    strokes_ = parseStrokes(session_.document().recipe().field.strokes);
  } catch (const Error& error) {
    strokes_.clear();
    strokesError_ = QString::fromUtf8(error.what());
  }
  if (strokes_.size() != before) selected_ = std::min(selected_, int(strokes_.size()) - 1);
  error_ = strokesError_;
  makeField();
  Q_EMIT changed();
}

// ---- drawing ----

void FieldEditor::begin(const SurfaceHit& hit) {
  if (!session_.painting().on()) return;
  path_.emplace(session_.painting().on());
  path_->add(hit);
  selected_ = -1;
  Q_EMIT changed();
}

void FieldEditor::extend(const SurfaceHit& hit) {
  if (path_ && path_->add(hit)) Q_EMIT changed();
}

void FieldEditor::end() {
  if (!path_) return;
  FieldStroke stroke = path_->stroke();
  path_.reset();
  if (stroke.points.size() < 2) return Q_EMIT changed();
  std::vector<FieldStroke> strokes = strokes_;
  strokes.push_back(std::move(stroke));
  write(tr("Paint stroke"), strokes);
  select(int(strokes_.size()) - 1);
}

void FieldEditor::drop() {
  path_.reset();
  Q_EMIT changed();
}

void FieldEditor::select(int stroke) {
  const int next = stroke < int(strokes_.size()) ? stroke : -1;
  if (std::exchange(selected_, next) != next) Q_EMIT changed();
}

void FieldEditor::erase(int stroke) {
  if (stroke < 0 || stroke >= int(strokes_.size())) return;
  std::vector<FieldStroke> strokes = strokes_;
  strokes.erase(strokes.begin() + stroke);
  selected_ = -1;
  write(tr("Erase stroke"), strokes);
}

void FieldEditor::eraseAll() {
  selected_ = -1;
  write(tr("Erase all strokes"), {});
}

void FieldEditor::write(const QString& name, const std::vector<FieldStroke>& strokes) {
  Recipe next = session_.document().recipe();
  next.field.strokes = strokesToText(strokes);
  session_.document().edit(name, next);
}

// ---- the field ----

void FieldEditor::setShown(bool shown) {
  if (shown == shown_) return;
  shown_ = shown;
  session_.painting().setNeeded(this, shown);
  if (shown)
    makeField();
  else
    hideField();
  Q_EMIT changed();
}

void FieldEditor::hideField() {
  ++run_;
  if (job_) session_.jobs().cancel(std::exchange(job_, 0));
  field_.reset();
  knots_.clear();
  madeOn_.reset();
  madeFor_.reset();
  session_.layers().setMarks(MarkOwner::Field, {});
}

void FieldEditor::makeField() {
  if (!shown_) return;
  const std::shared_ptr<const PaintSurface> on = session_.painting().on();
  if (!on || !strokesError_.isEmpty()) return hideField();
  const FieldRecipe& recipe = session_.document().recipe().field;
  if (on == madeOn_ && recipe == madeFor_) return;
  if (on != madeOn_) hideField();
  madeOn_ = on;
  madeFor_ = recipe;
  const quint64 run = ++run_;
  auto made = std::make_shared<Made>();
  job_ = session_.jobs().startQuietly(
      QStringLiteral("field"), tr("Orientation field"),
      [on, made, options = fieldOptionsOf(recipe)](Job& job) {
        made->field = std::make_shared<const OrientationField>(
            makeOrientationField(on->scene->mesh, on->surface, options, job));
        made->lines = fieldLines(*on, *made->field);
        made->knots = fieldKnots(on->surface, *made->field);
      },
      [self = QPointer(this), made, run](const JobInfo& info) {
        if (!self || run != self->run_) return;
        self->job_ = 0;
        if (info.state == JobState::Done) return self->take(*made);
        self->error_ = info.state == JobState::Failed ? info.error : tr("The field was not made.");
        self->madeFor_.reset();
        Q_EMIT self->changed();
      });
}

void FieldEditor::take(const Made& made) {
  field_ = made.field;
  knots_ = made.knots;
  session_.layers().setMarks(MarkOwner::Field, {made.lines});
  Q_EMIT changed();
}

}  // namespace prt::ui
