#pragma once
// The environments that are a click away, as rows of small pictures. Hovering names one, a click chooses it,
// the one in use is framed.

#include "ui/model/probe_library.h"

#include <QImage>
#include <QWidget>

#include <map>

namespace prt::ui {

class ProbeStrip : public QWidget {
  Q_OBJECT
 public:
  explicit ProbeStrip(ProbeLibrary& library, QWidget* parent = nullptr);

  /// The one in use, as ProbeLibrary calls it.
  void setCurrent(const QString& path);
  /// Where the picture of a probe is.
  QRect cell(int index) const;

  QSize sizeHint() const override { return {208, heightForWidth(208)}; }
  bool hasHeightForWidth() const override { return true; }
  int heightForWidth(int width) const override;

 Q_SIGNALS:
  void chosen(const QString& path);

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent*) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void follow();
  int probeAt(const QPoint& at) const;
  void choose(int index);

  ProbeLibrary& library_;
  QString current_;
  int hovered_ = -1;
  std::map<std::shared_ptr<const Image>, QImage> pictures_;
};

}  // namespace prt::ui
