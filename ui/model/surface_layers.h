#pragma once
// What lies over the picture of the surface: false colour and marks. Whoever has something to show sets it
// here; every canvas draws it.

#include "libprt/shade/surface_overlay.h"

#include <QObject>

#include <vector>

namespace prt::ui {

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
  void setMarks(SurfaceMarks marks) {
    if (marks.empty() && marks_.empty()) return;
    marks_ = std::move(marks);
    ++marksVersion_;
    Q_EMIT changed();
  }

  /// Colours of the scene's triangles, in place of the values; a canvas leaves out paint that does not fit
  /// its scene.
  void setPaint(SurfacePaint paint) {
    if (paint.empty() && paint_.empty()) return;
    paint_ = std::move(paint);
    ++paintVersion_;
    Q_EMIT changed();
  }

  const std::vector<float>& values() const { return values_; }
  const SurfacePaint& paint() const { return paint_; }
  const SurfaceMarks& marks() const { return marks_; }
  bool empty() const { return values_.empty() && paint_.empty() && marks_.empty(); }
  // Each grows with every change.
  quint64 valuesVersion() const { return valuesVersion_; }
  quint64 paintVersion() const { return paintVersion_; }
  quint64 marksVersion() const { return marksVersion_; }

 Q_SIGNALS:
  void changed();

 private:
  std::vector<float> values_;
  SurfacePaint paint_;
  SurfaceMarks marks_;
  quint64 valuesVersion_ = 0, paintVersion_ = 0, marksVersion_ = 0;
};

}  // namespace prt::ui
