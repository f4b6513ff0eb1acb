#pragma once
// A titled group of rows that folds away. Docks are columns of sections.

#include <QString>
#include <QWidget>

class QToolButton;
class QVBoxLayout;

namespace prt::ui {

class Section : public QWidget {
  Q_OBJECT
 public:
  explicit Section(const QString& title, QWidget* parent = nullptr);

  void setTitle(const QString& title);
  void add(QWidget* widget);
  void addLayout(class QLayout* layout);
  void setOpen(bool open);
  QString title() const;
  bool isOpen() const;

 Q_SIGNALS:
  void toggled(bool open);

 private:
  QToolButton* header_;
  QWidget* body_;
  QVBoxLayout* rows_;
};

/// The scrolling column that a dock shows: sections from the top, empty space below.
class DockColumn : public QWidget {
  Q_OBJECT
 public:
  explicit DockColumn(QWidget* parent = nullptr);
  void add(QWidget* widget);
  /// A widget that takes the space that is left.
  void addFilling(QWidget* widget);

 private:
  QVBoxLayout* rows_;
};

/// A labelled field that lines up with the rows of recipe parameters, for what belongs to the view.
QWidget* fieldRow(const QString& title, QWidget* field, const QString& tip);

}  // namespace prt::ui
