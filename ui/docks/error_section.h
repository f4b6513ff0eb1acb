#pragma once
// 'Where is this bake wrong?' in numbers: each cause with its error and share, what is laid over the surface,
// and what would help most.

#include "ui/widgets/section.h"

#include <array>

class QComboBox;
class QLabel;
class QPushButton;

namespace prt::ui {

class Session;
class ShareBar;

class ErrorSection : public Section {
  Q_OBJECT
 public:
  explicit ErrorSection(Session& session, QWidget* parent = nullptr);

 private:
  QWidget* makeTable();
  void refresh();

  Session& session_;
  QComboBox* shown_;
  QComboBox* judge_;
  QPushButton* measure_;
  // Filled by makeTable(), so before the table.
  std::array<QLabel*, 4> numbers_{};  // total, then the causes
  std::array<ShareBar*, 3> shares_{};
  QWidget* table_;
  QLabel* advice_;
  QPushButton* apply_;
};

}  // namespace prt::ui
