#pragma once
// A product's state as a dot: green done, amber out of date or on its way, red failed.

#include "ui/model/bake_controller.h"

#include <QWidget>

namespace prt::ui {

class StateDot : public QWidget {
  Q_OBJECT
 public:
  explicit StateDot(QWidget* parent = nullptr);
  void setStatus(ProductStatus status);
  ProductStatus status() const { return status_; }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  ProductStatus status_ = ProductStatus::Missing;
};

/// "fresh", "preview 3 of 8", "stale".
QString statusText(const StageInfo& info);

}  // namespace prt::ui
