#pragma once
// What was wrong with the selected object's file: a line for each class of defects with its number and what
// became of it. A click shows them on the surface; a second click hides them.

#include "libprt/mesh/defect_list.h"
#include "ui/widgets/section.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

class QLabel;
class QToolButton;
class QTreeWidget;

namespace prt {
struct MeshProduct;
}

namespace prt::ui {

class Session;

class MeshReport : public Section {
  Q_OBJECT
 public:
  explicit MeshReport(Session& session, QWidget* parent = nullptr);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  QWidget* makeStepper();
  void refill();
  void refreshShown();
  void clicked(int row);

  Session& session_;
  QLabel* facts_;
  QTreeWidget* lines_;
  QLabel* place_ = nullptr;  // made with the stepper, so before it
  QWidget* stepper_;
  QLabel* meaning_;
  QLabel* notes_;
  std::vector<DefectKind> kinds_;  // of the rows
  // What the rows are about: a product and an object in it.
  std::optional<std::pair<std::shared_ptr<const MeshProduct>, std::size_t>> filled_;
};

}  // namespace prt::ui
