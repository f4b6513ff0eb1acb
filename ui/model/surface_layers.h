#pragma once
// What lies over the picture of the surface: false colour and marks. Whoever has something to show sets it
// here; every canvas draws it.

#include "libprt/shade/surface_overlay.h"

#include <QObject>

#include <array>
#include <vector>

namespace prt::ui {

/// Who paints the surface; of several the last one is seen.
enum class PaintOwner { Charts, Ids };
/// Who marks the surface; later ones lie over earlier ones.
enum class MarkOwner { Layers, Wishes, Field, Defects };

class SurfaceLayers : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

  /// One value per vertex of the scene on the magnitude scale; empty: no false colour. A canvas leaves out
  /// values that do not fit its scene.
  void setValues(std::vector<float> values) {
    if (values.empty() && values_.empty()) return;
    values_ = std::move(values);
    ++valuesVersion_;
    Q_EMIT changed();
  }
  /// Layers of marks, the lowest first. A picture of the model takes longer than comparing them.
  void setMarks(MarkOwner owner, std::vector<SurfaceMarks> marks) {
    std::vector<SurfaceMarks>& own = marked_[std::size_t(owner)];
    if (own == marks) return;
    own = std::move(marks);
    marks_.clear();
    for (const auto& layers : marked_) marks_.insert(marks_.end(), layers.begin(), layers.end());
    ++marksVersion_;
    Q_EMIT changed();
  }

  /// Colours of the scene's triangles, in place of the values; a canvas leaves out paint that does not fit
  /// its scene.
  void setPaint(PaintOwner owner, SurfacePaint paint) {
    SurfacePaint& own = paints_[std::size_t(owner)];
    if (paint.empty() && own.empty()) return;
    own = std::move(paint);
    ++paintVersion_;
    Q_EMIT changed();
  }

  const std::vector<float>& values() const { return values_; }
  const SurfacePaint& paint() const { return paints_[1].empty() ? paints_[0] : paints_[1]; }
  const SurfacePaint& paintOf(PaintOwner owner) const { return paints_[std::size_t(owner)]; }
  /// Of all owners, the lowest first.
  const std::vector<SurfaceMarks>& marks() const { return marks_; }
  bool empty() const { return values_.empty() && paint().empty() && marks_.empty(); }
  // Each grows with every change.
  quint64 valuesVersion() const { return valuesVersion_; }
  quint64 paintVersion() const { return paintVersion_; }
  quint64 marksVersion() const { return marksVersion_; }

 Q_SIGNALS:
  void changed();

 private:
  std::vector<float> values_;
  std::array<SurfacePaint, 2> paints_;               // by owner
  std::array<std::vector<SurfaceMarks>, 4> marked_;  // by owner
  std::vector<SurfaceMarks> marks_;
  quint64 valuesVersion_ = 0, paintVersion_ = 0, marksVersion_ = 0;
};

}  // namespace prt::ui
