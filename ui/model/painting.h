#pragma once
// Painting on the model: which brush is in the hand, and the surface that it works on, which is read behind
// the interface while somebody needs it. One brush at a time, and none while charts are cut.

#include "libprt/synthesis/surface_darts.h"
#include "libprt/transport/scene.h"

#include <QObject>

#include <memory>
#include <set>

namespace prt::ui {

class Session;

enum class Brush { None, Strokes, Wishes, Layers };

/// What is painted on, with what brushes and pictures of it ask for again and again. Immutable.
struct PaintSurface {
  PaintSurface(std::shared_ptr<const Scene> from, Job& job);
  PaintSurface(const PaintSurface&) = delete;

  std::shared_ptr<const Scene> scene;
  Surface surface;
  SurfaceSheets sheets;  ///< of `surface`
  SurfaceDarts spread;   ///< points all over it, for lines that show a field
  double diagonal = 0;   ///< of its bounding box

  /// Unit shading normal.
  Vec3 normalAt(const SurfacePoint& point) const;
};

class Painting : public QObject {
  Q_OBJECT
 public:
  explicit Painting(Session& session, QObject* parent = nullptr);

  Brush brush() const { return brush_; }
  void take(Brush brush);
  /// The surface is read while somebody needs it; a brush in the hand does.
  void setNeeded(const QObject* who, bool needed);
  /// Null until it was read, and when it is not that of the scene any more.
  const std::shared_ptr<const PaintSurface>& on() const { return on_; }

 Q_SIGNALS:
  void brushChanged();
  void surfaceChanged();

 private:
  void follow();

  Session& session_;
  Brush brush_ = Brush::None;
  std::set<const QObject*> needing_;
  std::shared_ptr<const Scene> wanted_;  // that was read last, or is being read
  std::shared_ptr<const PaintSurface> on_;
};

}  // namespace prt::ui
