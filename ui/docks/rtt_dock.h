#pragma once
// The radiance transfer texture of the patch: how it looks under the light of the scene from any view, its
// views as they are baked, what it is baked with, and what it takes.

#include "ui/model/rtt_look.h"
#include "ui/widgets/section.h"

class QLabel;
class QProgressBar;
class QPushButton;

namespace prt::ui {

class Session;

class RttDock : public DockColumn {
  Q_OBJECT
 public:
  explicit RttDock(Session& session, QWidget* parent = nullptr);

 private:
  Section* makeBake();
  void refresh();
  /// The bake that runs and makes what this dock shows; null when none does.
  const JobInfo* ownJob() const;
  ProductStatus status() const;
  QString stateText() const;
  QString viewErrorText(const Rtt& rtt) const;

  Session& session_;
  RttLook look_;
  Section* square_;
  Section* views_;
  QLabel* viewText_;
  QLabel* state_;
  QProgressBar* bar_;
  QPushButton* button_;
};

}  // namespace prt::ui
