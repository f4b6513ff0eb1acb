#pragma once
// The File menu with everything around documents, the history in the Edit menu, and the one question that
// is modal: what to do with work that would be lost.

#include "ui/model/project_keeper.h"

#include <QObject>

class QMainWindow;
class QMenu;

namespace prt::ui {

class Session;

class DocumentMenu : public QObject {
  Q_OBJECT
 public:
  DocumentMenu(Session& session, QMainWindow& window);
  ~DocumentMenu() override;

  void fillFile(QMenu* menu);
  /// A submenu with every step: a click goes back to it, or forward.
  void fillHistory(QMenu* edit);

  void openFile();
  void saveProject(bool askForName);
  /// A dialog for files that are missing.
  void relink();

 private:
  void fillRecent();
  void fillBackups();
  void fillSteps();
  QString askForFile();
  LeaveAnswer ask(const Unsaved& unsaved);

  Session& session_;
  QMainWindow& window_;
  QMenu* recent_ = nullptr;
  QMenu* backups_ = nullptr;
  QMenu* history_ = nullptr;
};

/// What is unsaved, in a sentence or two.
QString describe(const Unsaved& unsaved);

}  // namespace prt::ui
