#pragma once
// All lights of the recipe, one row each: an eye that mutes, the colour, the name. One is selected, here, on
// the panorama and in the viewport alike. Double click or F2 renames, Space mutes, Delete deletes.

#include "ui/model/light_editor.h"

#include <QWidget>

class QLineEdit;

namespace prt::ui {

class ColorPicker;

class LightList : public QWidget {
  Q_OBJECT
 public:
  explicit LightList(LightEditor& lights, QWidget* parent = nullptr);

  QRect row(int light) const;
  QRect eye(int light) const;
  QRect swatch(int light) const;
  /// Opens a picker for the colour of a light that has one.
  void pickColor(int light);
  void rename(int light);

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {96, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent*) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void follow();
  int lightAt(const QPoint& at) const;
  bool colored(int light) const;
  void paintRow(QPainter& painter, int light) const;
  void closeEditor(bool keep);

  LightEditor& lights_;
  int hovered_ = -1;
  int picking_ = -1;  // the light whose colour is picked
  ColorPicker* picker_ = nullptr;
  QLineEdit* editor_ = nullptr;
  int renaming_ = -1;
};

}  // namespace prt::ui
