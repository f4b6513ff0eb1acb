#pragma once
// The knife: cuts are clicked on the surface, the way to the pointer shown before it is cut; Ctrl erases.
// What is cut is the chart editor's.

#include "ui/model/chart_editor.h"
#include "ui/viewport/manipulator.h"

#include <functional>

namespace prt::ui {

class SceneRays;

class CutTool : public Manipulator {
  Q_OBJECT
 public:
  using Pick = std::function<std::optional<SurfaceHit>(const QPointF&)>;

  /// It is enabled while the editor cuts.
  CutTool(ChartEditor& charts, const SceneRays& rays, Pick pick, QObject* parent = nullptr);

  void paint(QPainter& painter, const ViewGeometry& view) override;
  bool hover(std::optional<QPointF> at, const ViewGeometry& view) override;
  bool press(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) override;
  void move(const QPointF& at, Qt::KeyboardModifiers modifiers, const ViewGeometry& view) override;
  void release(const QPointF& at, const ViewGeometry& view) override;
  void cancel() override;
  bool doubleClick(const QPointF& at, const ViewGeometry& view) override;
  bool keyPress(int key) override;
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override;
  QList<Binding> bindings() const override;

  /// The vertex that a click at a place means: one that was clicked, or lies on a seam, is caught from some
  /// pixels away.
  std::optional<std::uint32_t> vertexAt(const QPointF& at, const ViewGeometry& view) const;

 private:
  /// Its neighbourhood of a place: what erasing takes there.
  std::optional<std::uint32_t> cutEdgeAt(const QPointF& at, const ViewGeometry& view) const;
  void paintWay(QPainter& painter, const ViewGeometry& view, const std::vector<std::uint32_t>& way,
                const QColor& color, Qt::PenStyle style) const;
  void paintEdges(QPainter& painter, const ViewGeometry& view, const std::vector<std::uint32_t>& edges,
                  const QColor& color, Qt::PenStyle style) const;
  void paintDot(QPainter& painter, const ViewGeometry& view, std::uint32_t vertex, double radius,
                const QColor& color) const;
  bool hidden(const Vec3& point, const ViewGeometry& view) const;

  ChartEditor& charts_;
  const SceneRays& rays_;
  Pick pick_;
  std::optional<std::uint32_t> hovered_;     // vertex
  std::optional<std::uint32_t> hoveredCut_;  // edge, while Ctrl is down
  std::optional<QPointF> pressedAt_;
  Qt::KeyboardModifiers modifiers_;
};

}  // namespace prt::ui
