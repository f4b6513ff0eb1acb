#pragma once
// The patch as a thing: drag turns it, the wheel zooms, a double click looks from where it began.

#include <QImage>
#include <QWidget>

namespace prt::ui {

class PatchPreview;

class PatchCanvas : public QWidget {
  Q_OBJECT
 public:
  explicit PatchCanvas(PatchPreview& preview, QWidget* parent = nullptr);

  QSize sizeHint() const override { return {248, 176}; }

 protected:
  void paintEvent(QPaintEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void showEvent(QShowEvent*) override;
  void hideEvent(QHideEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent*) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void follow();
  QString message() const;

  PatchPreview& preview_;
  QImage picture_;
  QPointF last_;
};

}  // namespace prt::ui
