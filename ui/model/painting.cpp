#include "ui/model/painting.h"

#include "ui/model/chart_editor.h"
#include "ui/model/session.h"

#include <QPointer>

#include <utility>

namespace prt::ui {

namespace {
constexpr std::size_t kSpread = 2200;  // points all over the surface
}  // namespace

PaintSurface::PaintSurface(std::shared_ptr<const Scene> from, Job& job)
    : scene(std::move(from)),
      surface(scene->mesh, job),
      sheets(surface),
      spread(throwDarts(sheets, kSpread, kSpread, 1, job)),
      diagonal(double(scene->mesh.bounds().diagonal())) {}

Vec3 PaintSurface::normalAt(const SurfacePoint& point) const {
  const UVec3& t = scene->mesh.triangles[point.triangle];
  const auto& n = scene->mesh.normals;
  const Vec3 sum = interpolated(n[t.x], n[t.y], n[t.z], point.barycentric);
  return dot(sum, sum) > 0 ? normalize(sum) : sheets.normal[point.triangle];
}

Painting::Painting(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_.relighter(), &Relighter::sceneChanged, this, &Painting::follow);
  connect(&session_.document(), &Document::opened, this, [this] { take(Brush::None); });
  connect(&session_.charts(), &ChartEditor::cutChanged, this, [this] {
    if (session_.charts().cutting()) take(Brush::None);
  });
}

void Painting::take(Brush brush) {
  if (brush == brush_) return;
  brush_ = brush;
  if (brush_ != Brush::None) session_.charts().setCutting(false);
  setNeeded(this, brush_ != Brush::None);
  Q_EMIT brushChanged();
}

void Painting::setNeeded(const QObject* who, bool needed) {
  if (needed)
    needing_.insert(who);
  else
    needing_.erase(who);
  follow();
}

void Painting::follow() {
  const auto& scene = session_.relighter().scene();
  if (on_ && on_->scene != scene) {
    on_.reset();
    Q_EMIT surfaceChanged();
  }
  if (wanted_ != scene) wanted_.reset();
  if (needing_.empty() || !scene || scene == wanted_) return;
  wanted_ = scene;
  auto made = std::make_shared<std::shared_ptr<const PaintSurface>>();
  session_.jobs().startQuietly(
      QStringLiteral("paint surface"), tr("Read the surface for painting"),
      [made, scene](Job& job) { *made = std::make_shared<const PaintSurface>(scene, job); },
      [self = QPointer(this), made, scene](const JobInfo&) {
        if (!self || self->wanted_ != scene) return;
        if (!*made) return self->wanted_.reset();  // cancelled, or it has no area
        if (self->session_.relighter().scene() != scene) return;
        self->on_ = *made;
        Q_EMIT self->surfaceChanged();
      });
}

}  // namespace prt::ui
