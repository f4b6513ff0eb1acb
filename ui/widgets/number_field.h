#pragma once
// A number that is scrubbed by dragging (Shift fine, Ctrl coarse), stepped by the wheel and the arrow
// keys when it has the focus, or typed, with units and arithmetic. A quiet bar behind it shows where the
// value lies in its range.

#include "ui/widgets/binding.h"

#include <QElapsedTimer>
#include <QString>
#include <QWidget>

class QLineEdit;

namespace prt::ui {

struct NumberFormat {
  double low = 0, high = 0;  ///< equal: no limits
  int decimals = 3;          ///< most that are shown; 0 = whole numbers
  bool logarithmic = false;  ///< equal drags multiply by equal factors; needs low > 0
  QString unit;              ///< shown behind the number
  double step = 0;           ///< of wheel and arrow keys; 0 = chosen from the range
  QString prefix = {};       ///< shown before the number, at the left
};

class NumberField : public QWidget {
  Q_OBJECT
 public:
  explicit NumberField(const NumberFormat& format, QWidget* parent = nullptr);

  double value() const { return value_; }
  /// Shows a value; says nothing.
  void setValue(double value);
  const NumberFormat& format() const { return format_; }
  QString text() const;
  /// All that mouse and keys do on a number.
  static QList<Binding> bindings();
  /// The same in one line, for the status bar.
  static QString hint();
  bool editing() const;

  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

  /// One drag by `pixels` from the value at its beginning, as the mouse would do it.
  double scrubbed(double from, double pixels, Qt::KeyboardModifiers modifiers) const;

 Q_SIGNALS:
  /// The user changed the value.
  void edited(double value);
  /// Around everything that one drag changes.
  void gestureBegan();
  void gestureEnded();
  void resetRequested();

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent*) override;
  void enterEvent(QEnterEvent*) override { update(); }
  void leaveEvent(QEvent*) override { update(); }
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void change(double value);
  void stepBy(double steps, Qt::KeyboardModifiers modifiers);
  double bounded(double value) const;
  double fraction() const;
  void beginEditing();
  void commit();
  void closeEditor();

  NumberFormat format_;
  double value_ = 0;
  QLineEdit* editor_ = nullptr;
  QElapsedTimer editingSince_;
  bool pressed_ = false, scrubbing_ = false;
  QPointF pressedAt_;
  double valueAtPress_ = 0;
};

}  // namespace prt::ui
