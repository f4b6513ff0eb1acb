#pragma once
// The charts in two dimensions: all of them where they lie in the atlas, to be dragged, turned and scaled; or
// one of them alone, with the corners of its polygon to be moved along its boundary.

#include "ui/model/chart_picture.h"
#include "ui/widgets/binding.h"

#include <QImage>
#include <QWidget>

#include <optional>

namespace prt::ui {

class ChartView : public QWidget {
  Q_OBJECT
 public:
  explicit ChartView(ChartEditor& charts, QWidget* parent = nullptr);

  /// The atlas, or the selected chart alone.
  bool showsOne() const { return one_; }
  void setShowsOne(bool one);
  /// All of what is shown fills the view.
  void fit();

  /// Places of this widget: of a point of the plane that is shown; of the selected chart's handles.
  QPointF toView(const DVec2& place) const;
  DVec2 toPlane(const QPointF& at) const;
  std::optional<QPointF> turnHandle() const;
  std::optional<QRectF> scaleBox() const;  ///< a chart's box: its corners scale it
  QPointF cornerAt(int corner) const;      ///< of the polygon, showsOne()
  static QList<Binding> bindings();

  QSize sizeHint() const override { return {240, 240}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override { return width; }

 Q_SIGNALS:
  void showsOneChanged(bool one);

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent*) override;

 private:
  enum class Grip { None, Move, Scale, Turn, Corner, Pan };
  void follow();
  void fitNow();
  ChartWindow window() const;
  int shownChart() const { return one_ ? charts_.selected() : -1; }
  bool movable(int chart) const;
  Grip gripAt(const QPointF& at);
  void beginDrag();
  void dragChart(const QPointF& at, Qt::KeyboardModifiers modifiers);
  DVec2 snapped(const ChartPlacement& placement) const;
  void dragCorner(const QPointF& at);
  std::optional<std::size_t> boundaryAt(const QPointF& at, double reach) const;
  void endDrag(bool keep);
  void nudge(const DVec2& texels);
  QRectF boxOf(int chart, const ChartPlacement& placement) const;
  void paintOutlines(QPainter& painter) const;
  void paintHandles(QPainter& painter) const;
  void paintCorners(QPainter& painter) const;
  void paintLegend(QPainter& painter) const;
  QString emptyText() const;

  ChartEditor& charts_;
  bool one_ = false, fitted_ = true;
  DVec2 middle_{0.5};
  double zoom_ = 200;  // logical pixels per unit of the plane
  QImage picture_;     // of picturedWindow
  bool stale_ = true;

  Grip grip_ = Grip::None, hovered_ = Grip::None;
  int chart_ = -1, corner_ = -1, hoveredCorner_ = -1;
  bool dragging_ = false;
  QPointF pressedAt_, last_;
  ChartPlacement atPress_;
  std::vector<std::uint32_t> cornersAtPress_;
};

}  // namespace prt::ui
