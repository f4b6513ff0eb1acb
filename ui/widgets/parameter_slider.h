#pragma once
// A parameter of the recipe as a slider over its whole range, with its marks: decades where the range is wide
// and positive, so that every decade gets the same room. Everything comes from the recipe's parameter table;
// a drag is one step of undo. Stands under the parameter's row, lined up with its field.

#include "ui/model/document.h"

#include <QWidget>

namespace prt::ui {

class ParameterSlider : public QWidget {
  Q_OBJECT
 public:
  /// `path` as in the recipe, of a number with a range. Throws ValueError when there is no such parameter.
  ParameterSlider(Document& document, const QString& path, QWidget* parent = nullptr);

  double value() const { return value_; }
  bool logarithmic() const { return logarithmic_; }
  /// Where a value's place on the track is, in pixels; and the reverse, within the range.
  double placeOf(double value) const;
  double valueAt(double x) const;
  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void enterEvent(QEnterEvent*) override { update(); }
  void leaveEvent(QEvent*) override { update(); }

 private:
  void refresh();
  void change(double value);
  std::vector<double> marks() const;

  Document& document_;
  QString path_;
  const Parameter& parameter_;
  bool logarithmic_;
  double value_ = 0;
  bool dragging_ = false;
};

}  // namespace prt::ui
