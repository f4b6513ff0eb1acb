#pragma once
// What is baked, how, and whether it is up to date; one button to bake or to cancel.

#include "ui/widgets/section.h"

class QCheckBox;
class QLabel;
class QPushButton;

namespace prt::ui {

class MessageBar;
class Session;

class TransferDock : public DockColumn {
  Q_OBJECT
 public:
  explicit TransferDock(Session& session, QWidget* parent = nullptr);

 private:
  void refresh();
  void refreshProducts();

  Session& session_;
  MessageBar* message_;
  QWidget* texels_ = nullptr;  // their number, which means something at texels only
  QPushButton* button_;
  QLabel* summary_;
  QWidget* products_;
};

}  // namespace prt::ui
