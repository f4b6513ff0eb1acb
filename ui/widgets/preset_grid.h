#pragma once
// The material presets as a grid of small spheres. Hovering names one, a click applies it; the one that the
// material is exactly is framed.

#include <QImage>
#include <QStringList>
#include <QWidget>

#include <vector>

namespace prt::ui {

class PresetGrid : public QWidget {
  Q_OBJECT
 public:
  explicit PresetGrid(QWidget* parent = nullptr);

  /// Names and what to say of them, in order.
  void setPresets(const QStringList& names, const QStringList& tips);
  void setPictures(std::vector<QImage> pictures);
  /// -1: none.
  void setCurrent(int index);
  int current() const { return current_; }
  QRect cell(int index) const;

  QSize sizeHint() const override { return {240, heightForWidth(240)}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;

 Q_SIGNALS:
  void chosen(int index);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent*) override;
  bool event(QEvent* event) override;

 private:
  int presetAt(const QPoint& at) const;

  QStringList names_, tips_;
  std::vector<QImage> pictures_;
  int current_ = -1, hovered_ = -1;
};

}  // namespace prt::ui
