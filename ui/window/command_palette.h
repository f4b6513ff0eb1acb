#pragma once
// Every command by a few letters of its name: Ctrl+K. Enter runs the chosen one, or goes to the row of a
// parameter; "transfer.bands = 6" sets a value at once. What was used recently leads.

#include "ui/model/command_index.h"
#include "ui/window/sheet.h"

class QLineEdit;
class QListView;

namespace prt::ui {

class CommandListModel;

class CommandPalette : public Sheet {
  Q_OBJECT
 public:
  /// What there is to find, asked each time it opens.
  using Collect = std::function<std::vector<Command>()>;
  /// A command for a line that says what to do by itself ("path = value"), or nothing. An error is told by
  /// the title of a command that is not enabled.
  using Interpret = std::function<std::optional<Command>(const QString& line)>;

  CommandPalette(QWidget* window, Collect collect, Interpret interpret);
  ~CommandPalette() override;

  /// Opens with a line already typed, the cursor at its end.
  void openWith(const QString& line);
  /// What is listed now, for those who look without eyes.
  QStringList titles() const;

 protected:
  QRect panelPlace(const QSize& window) const override;
  QWidget* aboutToOpen() override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void refresh();
  void runCurrent();
  void move(int by);

  Collect collect_;
  Interpret interpret_;
  CommandListModel* model_;
  QLineEdit* line_;
  QListView* list_;
  QString typed_;  // by openWith
};

}  // namespace prt::ui
