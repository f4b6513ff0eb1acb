#pragma once
// What the radiance transfer texture of the patch looks like under the light of the scene: the square patch
// from any view, and small pictures of all views of the table. The patch lies on the ground, its tangent
// along +X.

#include "libprt/core/image.h"
#include "libprt/meso/rtt.h"
#include "libprt/project/patch_stages.h"
#include "ui/model/bake_controller.h"
#include "ui/model/relighter.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace prt::ui {

class RttLook : public QObject {
  Q_OBJECT
 public:
  RttLook(BakeController& bakes, Relighter& relighter, JobRunner& jobs, QObject* parent = nullptr);

  /// Another document: nothing is known of its patch yet.
  void forget();
  /// Pictures are made while somebody looks.
  void setWatched(bool watched);
  /// Towards the viewer, in the patch's frame: unit, z > 0.
  const Vec3& view() const { return view_; }
  void setView(const Vec3& view);
  /// The view whose cell of the table holds view(); -1 without a table.
  int viewIndex() const;
  /// Looks from the middle of that cell.
  void setViewIndex(int index);

  /// Null while there is none.
  const std::shared_ptr<const Rtt>& rtt() const { return rtt_; }
  /// Images done and wanted of the bake that it came from; equal when it is final.
  int level() const { return level_; }
  int levels() const { return levels_; }
  double storageError() const { return storageError_; }
  /// What interpolating between its views costs; none before it is final, nor for imported images.
  const std::optional<ViewError>& viewError() const { return viewError_; }
  /// Linear radiance, v = 1 at the top, one pixel a texel; empty without a table.
  const Image& square() const { return square_; }
  /// The same of every view, rows of the view square from the top, smaller.
  const std::vector<Image>& thumbnails() const { return thumbnails_; }

 Q_SIGNALS:
  void changed();

 private:
  void take(const ProductState& state);
  void refresh();
  void start();

  Relighter& relighter_;
  JobRunner& jobs_;
  Vec3 view_;
  std::shared_ptr<const Rtt> rtt_;
  int level_ = 0, levels_ = 0;
  double storageError_ = 0;
  std::optional<ViewError> viewError_;
  Image square_;
  std::vector<Image> thumbnails_;
  bool watched_ = false, running_ = false, again_ = false;
};

}  // namespace prt::ui
