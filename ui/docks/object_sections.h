#pragma once
// What one object of the scene is: where it stands, how its mesh is read, whether it carries the patch, and
// whether it stands around the others.

#include "ui/widgets/section.h"

class QPushButton;

namespace prt::ui {

class NumberField;
class Session;

class ObjectSections : public QWidget {
  Q_OBJECT
 public:
  explicit ObjectSections(Session& session, QWidget* parent = nullptr);

 private:
  void rebuild();
  void refresh();
  QWidget* makeTransform(const QString& base);
  QWidget* makeMesh(const QString& base);
  QWidget* makePatch(const QString& base);
  QWidget* makeSurroundings(const QString& base);

  Session& session_;
  QWidget* rows_ = nullptr;
  NumberField* size_ = nullptr;
  QPushButton* rest_ = nullptr;
  QPushButton* centre_ = nullptr;
  QWidget* emission_ = nullptr;
  bool builtin_ = false;  // the rows are those of a built-in mesh
  bool transformOpen_ = false, meshOpen_ = false, patchOpen_ = false,
       aroundOpen_ = false;  // as the user left them
};

}  // namespace prt::ui
