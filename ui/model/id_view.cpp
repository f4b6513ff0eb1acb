#include "ui/model/id_view.h"

#include "libprt/project/atlas_stages.h"
#include "libprt/project/export_synthesis.h"
#include "ui/model/session.h"

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {
constexpr int kMostTexels = 1024;  // a side of what is painted: finer than the screen shows
}  // namespace

IdView::IdView(Session& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&session_.bakes(), &BakeController::productArrived, this, &IdView::take);
  connect(&session_.relighter(), &Relighter::sceneChanged, this, &IdView::paint);
  connect(&session_.document(), &Document::opened, this, [this] {
    atlas_.reset();
    map_.reset();
    paint();
    Q_EMIT changed();
  });
}

void IdView::setShown(bool shown) {
  if (std::exchange(shown_, shown) == shown) return;
  paint();
  Q_EMIT changed();
}

void IdView::take(const QString& stage, const ProductState& state) {
  if (stage == u"atlas") {
    const auto product = std::dynamic_pointer_cast<const AtlasProduct>(state.product);
    atlas_ = product ? product->atlas : nullptr;
  } else if (stage == u"idmap") {
    const auto product = std::dynamic_pointer_cast<const IdMapProduct>(state.product);
    map_ = product ? product->map : nullptr;
  } else {
    return;
  }
  paint();
  Q_EMIT changed();
}

void IdView::paint() {
  const auto& scene = session_.relighter().scene();
  SurfacePaint paint;
  if (shown_ && available() && scene && atlas_->triangleCount() == scene->mesh.triangleCount()) {
    paint.picture = std::make_shared<const Image>(idMapPicture(*map_, std::min(map_->size, kMostTexels)));
    paint.uv.reserve(3 * atlas_->triangleCount());
    for (const UVec3& t : atlas_->uvTriangles)
      for (int k = 0; k < 3; ++k) paint.uv.push_back(atlas_->uv[t[k]]);
  }
  session_.layers().setPaint(PaintOwner::Ids, std::move(paint));
}

}  // namespace prt::ui
