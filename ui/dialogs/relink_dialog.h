#pragma once
// Files that a project names and that are not where it says: searches a folder for them and takes what was
// found. Not modal: the project is open with what it has.

#include "libprt/project/linked_files.h"

#include <QDialog>

#include <map>
#include <string>

class QLabel;
class QPushButton;
class QTreeWidget;

namespace prt::ui {

class ProjectKeeper;

class RelinkDialog : public QDialog {
  Q_OBJECT
 public:
  RelinkDialog(ProjectKeeper& project, QWidget* parent = nullptr);

  /// Searches a folder; what the Locate button does once one was chosen.
  void search(const QString& folder);

 private:
  void refresh();
  void take(const std::map<std::string, FoundFile>& found);
  void apply();

  ProjectKeeper& project_;
  std::map<std::string, FoundFile> found_;
  QTreeWidget* files_;
  QLabel* result_;
  QPushButton* locate_;
  QPushButton* relink_;
};

}  // namespace prt::ui
