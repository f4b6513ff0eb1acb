#include "ui/model/rtt_look.h"

#include "libprt/shade/patch_square.h"

#include <QPointer>

#include <algorithm>

namespace prt::ui {

namespace {

constexpr int kThumbnail = 24;  // pixels a side: a texel each, or every few

// A picture of one view, of one texel in every few where there are many.
Image thumbnail(const Rtt& rtt, int view, const ShRgb& light) {
  const int side = std::min(kThumbnail, rtt.texels);
  Image image(side, side, 3);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int u = (2 * x + 1) * rtt.texels / (2 * side), v = (2 * y + 1) * rtt.texels / (2 * side);
      const Rgb c = max(rtt.exitRadiance(u, rtt.texels - 1 - v, view, light), Rgb(0));
      std::copy_n(&c.x, 3, image.pixel(x, y));
    }
  return image;
}

struct Pictures {
  Image square;
  std::vector<Image> thumbnails;

  void make(const Rtt& rtt, const Vec3& view, const ShRgb& light, Job& job) {
    square = previewImage(rtt, view, light);
    for (int y = rtt.views - 1; y >= 0; --y)
      for (int x = 0; x < rtt.views; ++x) {
        job.checkCancelled();
        thumbnails.push_back(thumbnail(rtt, y * rtt.views + x, light));
      }
  }
};

}  // namespace

RttLook::RttLook(BakeController& bakes, Relighter& relighter, JobRunner& jobs, QObject* parent)
    : QObject(parent), relighter_(relighter), jobs_(jobs), view_(normalize(Vec3(0.3f, -0.4f, 1))) {
  connect(&bakes, &BakeController::productArrived, this,
          [this](const QString& stage, const ProductState& state) {
            if (stage == QLatin1String("rtt")) take(state);
          });
  connect(&relighter_, &Relighter::changed, this, &RttLook::refresh);
}

void RttLook::forget() {
  rtt_.reset();
  refresh();
}

void RttLook::setWatched(bool watched) {
  if (std::exchange(watched_, watched) != watched) refresh();
}

void RttLook::setView(const Vec3& view) {
  view_ = view;
  refresh();
}

int RttLook::viewIndex() const {
  return rtt_ ? ViewSquare(rtt_->views).nearest(view_) : -1;
}

void RttLook::setViewIndex(int index) {
  if (rtt_ && index >= 0 && index < rtt_->viewCount()) setView(ViewSquare(rtt_->views).centre(index));
}

void RttLook::take(const ProductState& state) {
  const auto product = std::dynamic_pointer_cast<const RttProduct>(state.product);
  rtt_ = product ? product->rtt : nullptr;
  storageError_ = product ? product->storageError : 0;
  viewError_ = product ? product->viewError : std::nullopt;
  level_ = state.level, levels_ = state.levels;
  refresh();
}

void RttLook::refresh() {
  if (!rtt_) {
    square_ = {};
    thumbnails_.clear();
    Q_EMIT changed();
    return;
  }
  if (!watched_) return;
  if (running_)
    again_ = true;
  else
    start();
}

void RttLook::start() {
  again_ = false;
  running_ = true;
  auto made = std::make_shared<Pictures>();
  jobs_.startQuietly(
      QStringLiteral("views of the patch"), tr("Pictures of the patch"),
      [made, rtt = rtt_, view = view_, light = lightOnGround(relighter_.light())](Job& job) {
        made->make(*rtt, view, light, job);
      },
      [self = QPointer(this), made](const JobInfo& info) {
        if (!self) return;
        self->running_ = false;
        if (info.state == JobState::Done && self->rtt_)
          self->square_ = std::move(made->square), self->thumbnails_ = std::move(made->thumbnails);
        if (self->again_) self->refresh();
        Q_EMIT self->changed();
      });
}

}  // namespace prt::ui
