#include "ui/model/patch_preview.h"

#include "libprt/core/error.h"
#include "libprt/project/patch_stages.h"
#include "ui/model/layer_editor.h"

#include <QLocale>
#include <QPointer>

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {
constexpr int kMostGrid = 192;  // vertices a side of a height field: quick enough to follow a drag
constexpr float kLowest = 0.03f, kHighest = 1.57f;

QString factsOf(const Patch& patch) {
  return QObject::tr("%1 triangles, %2 deep")
      .arg(QLocale().toString(qulonglong(patch.mesh.triangleCount())))
      .arg(double(patch.depth()), 0, 'g', 3);
}
}  // namespace

// What one picture is made of, and what came of it.
struct PatchPreview::Task {
  PatchOptions options;
  std::filesystem::path folder;
  PatchView view;
  int width = 0, height = 0, views = 0;
  std::shared_ptr<const PatchScene> scene;  // null: to be built
  Image picture;
  QString facts, warning, error;

  void build(Job& job) {
    PatchOptions coarse = options;
    coarse.grid = std::min(coarse.grid, kMostGrid);
    auto patch =
        std::make_shared<const Patch>(buildPatch(coarse, loadPatchSources(options, folder, job), job));
    facts = factsOf(*patch);
    warning = QString::fromStdString(thinPatchWarning(*patch, views));
    scene = std::make_shared<const PatchScene>(makePatchRays(std::move(patch), job));
  }

  void run(Job& job) {
    try {
      if (!scene) build(job);
      picture = patchPicture(*scene, view, width, height, job);
    } catch (const Cancelled&) {
      throw;
    } catch (const std::exception& failure) {  // belongs beside the parameters, not into the list of jobs
      error = QString::fromUtf8(failure.what());
    }
  }
};

PatchPreview::PatchPreview(Document& document, JobRunner& jobs, QObject* parent)
    : QObject(parent), document_(document), jobs_(jobs) {
  connect(&document_, &Document::recipeChanged, this, [this] {
    const Recipe& recipe = document_.recipe();
    if (options() != made_ || recipe.rtt.views != views_) request(document_.inGesture());
  });
}

void PatchPreview::setLayer(int layer) {
  if (layer == layer_) return;
  layer_ = layer;
  request(false);
}

const PatchOptions& PatchPreview::options() const {
  return patchOf(document_.recipe(), layer_);
}

bool PatchPreview::hasShape() const {
  const PatchModel model = options().model;
  return model != PatchModel::None && model != PatchModel::Btf;
}

void PatchPreview::setWatched(bool watched) {
  if (std::exchange(watched_, watched) != watched && watched) request(false);
}

void PatchPreview::setSize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width, height_ = height;
  request(false);
}

void PatchPreview::setView(const PatchView& view) {
  view_ = view;
  request(true);
}

void PatchPreview::turn(float azimuth, float elevation) {
  PatchView view = view_;
  view.azimuth = std::remainder(view.azimuth + azimuth, 2 * kPiF);
  view.elevation = std::clamp(view.elevation + elevation, kLowest, kHighest);
  setView(view);
}

void PatchPreview::zoom(float factor) {
  PatchView view = view_;
  view.zoom = std::clamp(view.zoom * factor, 0.5f, 8.0f);
  setView(view);
}

void PatchPreview::request(bool moving) {
  moving_ = moving;
  if (!watched_ || width_ < 1 || height_ < 1) return;
  if (running_) {
    again_ = true;
    return;
  }
  start();
}

void PatchPreview::start() {
  again_ = false;
  if (!hasShape()) {
    scene_.reset();
    made_ = options();
    picture_ = {};
    facts_.clear(), warning_.clear(), error_.clear();
    Q_EMIT changed();
    return;
  }
  auto task = std::make_shared<Task>();
  task->options = options(), task->views = document_.recipe().rtt.views;
  task->folder = document_.folder();
  task->view = view_, task->view.samples = moving_ ? 1 : 3;
  task->width = width_, task->height = height_;
  const bool same = scene_ && task->options == made_ && task->views == views_ && task->folder == folder_;
  if (same) task->scene = scene_, task->facts = facts_, task->warning = warning_;
  running_ = true;
  jobs_.startQuietly(
      QStringLiteral("patch picture"), tr("Picture of the patch"), [task](Job& job) { task->run(job); },
      [self = QPointer(this), task](const JobInfo& info) {
        if (!self) return;
        self->running_ = false;
        if (info.state == JobState::Done) self->take(*task);
      });
}

void PatchPreview::take(const Task& task) {
  scene_ = task.scene, made_ = task.options, views_ = task.views, folder_ = task.folder;
  facts_ = task.facts, warning_ = task.warning, error_ = task.error;
  if (error_.isEmpty()) picture_ = task.picture;
  const bool coarse = task.view.samples == 1;
  if (again_)
    start();
  else if (coarse && error_.isEmpty())
    moving_ = false, start();  // it stands still: a finer one
  Q_EMIT changed();
}

}  // namespace prt::ui
