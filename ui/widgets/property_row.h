#pragma once
// One parameter of the recipe as one row: label, field, reset. The row knows its parameter only by path;
// range, unit, default, tooltip and cost come from the recipe's parameter table.

#include "ui/model/document.h"

#include <QWidget>

#include <functional>

class QLabel;
class QToolButton;

namespace prt::ui {

class PropertyRow : public QWidget {
  Q_OBJECT
 public:
  /// `path` as in the recipe, indices included ("lights[0].rotation"). Throws ValueError when there is
  /// no such parameter.
  PropertyRow(Document& document, const QString& path, const QString& title = {}, QWidget* parent = nullptr);

  const QString& path() const { return path_; }
  QWidget* editor() const { return editor_; }
  /// The value as the recipe has it, as JSON text.
  QString valueText() const;
  bool isDefault() const;

  /// Sets the value from text as Document::set, showing a refusal beside the field.
  void apply(const QString& value);
  void reset();

 protected:
  void contextMenuEvent(QContextMenuEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* makeEditor();
  QWidget* makeNumber();
  QWidget* makeColor();
  QWidget* makeChoice();
  QWidget* makeToggle();
  QWidget* makeVector();
  QWidget* makeText();
  void arrange();
  void refresh();
  void scrubFromLabel(QEvent* event);

  Document& document_;
  QString path_;
  const Parameter& parameter_;
  QString title_;
  QLabel* label_;
  std::function<void()> show_;  // puts the recipe's value into the editor; before it, whose maker sets this
  QWidget* editor_;
  QToolButton* reset_;
};

/// The tooltip of a parameter: what it is, unit, range, default, cost of a change.
QString parameterTip(const Parameter& parameter);

}  // namespace prt::ui
