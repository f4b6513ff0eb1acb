#pragma once
// Three numbers side by side, each scrubbed and typed like any other: a place, angles, a scale.

#include "libprt/core/math.h"
#include "ui/widgets/number_field.h"

#include <array>

namespace prt::ui {

class VectorField : public QWidget {
  Q_OBJECT
 public:
  /// `format` is that of each number; the axis stands in front of it.
  explicit VectorField(const NumberFormat& format, QWidget* parent = nullptr);

  Vec3 value() const;
  /// Shows a value; says nothing.
  void setValue(const Vec3& value);
  NumberField& axis(int i) { return *fields_[std::size_t(i)]; }

 Q_SIGNALS:
  /// The user changed one of the numbers; the others are as they were set, in full precision.
  void edited(const prt::Vec3& value);
  void gestureBegan();
  void gestureEnded();
  void resetRequested();

 private:
  std::array<NumberField*, 3> fields_;
  Vec3 value_{0};
};

}  // namespace prt::ui
