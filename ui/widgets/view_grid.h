#pragma once
// Small pictures of all views of a radiance transfer texture, laid out as its view square is: the zenith in
// the middle, the horizon along the border. A click looks from there.

#include <QImage>
#include <QWidget>

#include <vector>

namespace prt::ui {

class RttLook;
class ViewState;

class ViewGrid : public QWidget {
  Q_OBJECT
 public:
  ViewGrid(RttLook& look, const ViewState& view, QWidget* parent = nullptr);

  /// Where the picture of a view of the table is.
  QRectF cell(int view) const;
  QSize sizeHint() const override { return {248, 248}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return width; }

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void follow();
  int side() const;
  int viewAt(const QPointF& at) const;

  RttLook& look_;
  const ViewState& view_;
  std::vector<QImage> pictures_;
};

}  // namespace prt::ui
