#include "ui/widgets/vector_field.h"

#include "ui/widgets/theme.h"

#include <QHBoxLayout>

namespace prt::ui {

VectorField::VectorField(const NumberFormat& format, QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kGrid / 2);
  const QString axes[] = {QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("z")};
  for (int i = 0; i < 3; ++i) {
    NumberFormat each = format;
    each.prefix = axes[i];
    auto* field = fields_[std::size_t(i)] = new NumberField(each);
    field->setObjectName(axes[i]);
    row->addWidget(field, 1);
    connect(field, &NumberField::edited, this, [this, i](double number) {
      value_[i] = float(number);
      Q_EMIT edited(value_);
    });
    connect(field, &NumberField::gestureBegan, this, &VectorField::gestureBegan);
    connect(field, &NumberField::gestureEnded, this, &VectorField::gestureEnded);
    connect(field, &NumberField::resetRequested, this, &VectorField::resetRequested);
  }
  setFocusProxy(fields_[0]);
}

Vec3 VectorField::value() const {
  return value_;
}

void VectorField::setValue(const Vec3& value) {
  value_ = value;
  for (int i = 0; i < 3; ++i) fields_[std::size_t(i)]->setValue(double(value[i]));
}

}  // namespace prt::ui
