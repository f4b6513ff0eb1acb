#pragma once
// The patch that the recipe asks for, as a thing to look at: built and drawn behind the interface whenever a
// parameter changes or it is turned. Of the newest request only; while one is drawn the next one waits, so
// that a drag shows pictures all along.

#include "libprt/core/image.h"
#include "libprt/meso/patch_build.h"
#include "libprt/meso/patch_picture.h"
#include "ui/model/document.h"
#include "ui/model/job_runner.h"

#include <QObject>
#include <QString>

#include <filesystem>
#include <memory>

namespace prt::ui {

class PatchPreview : public QObject {
  Q_OBJECT
 public:
  PatchPreview(Document& document, JobRunner& jobs, QObject* parent = nullptr);

  /// Which of the recipe's, see patchOf().
  void setLayer(int layer);
  int layer() const { return layer_; }
  /// Pictures are made while somebody looks.
  void setWatched(bool watched);
  /// Of the picture, in pixels.
  void setSize(int width, int height);
  const PatchView& view() const { return view_; }
  void setView(const PatchView& view);
  /// Turns by radians; the patch is never seen from below.
  void turn(float azimuth, float elevation);
  void zoom(float factor);

  /// The recipe asks for a patch that has a shape.
  bool hasShape() const;
  /// The last picture: linear RGBA. Empty until there is one, and without a patch.
  const Image& picture() const { return picture_; }
  /// What it shows is what the recipe asks for.
  bool current() const { return !running_ && !again_; }
  /// "63 488 triangles, 0.12 deep"; what is wrong with its thickness; why it cannot be made. Empty: nothing.
  const QString& facts() const { return facts_; }
  const QString& warning() const { return warning_; }
  const QString& error() const { return error_; }

 Q_SIGNALS:
  void changed();

 private:
  struct Task;
  const PatchOptions& options() const;
  void request(bool moving);
  void start();
  void take(const Task& task);

  Document& document_;
  JobRunner& jobs_;
  int layer_ = -1;
  PatchView view_;
  int width_ = 0, height_ = 0;
  bool watched_ = false, running_ = false, again_ = false, moving_ = false;
  // The scene that was drawn last, and what it was made of.
  std::shared_ptr<const PatchScene> scene_;
  PatchOptions made_;
  std::filesystem::path folder_;
  int views_ = 0;
  Image picture_;
  QString facts_, warning_, error_;
};

}  // namespace prt::ui
