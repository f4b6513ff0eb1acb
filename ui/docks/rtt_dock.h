#pragma once
// The radiance transfer texture of the patch: how it looks under the light of the scene from any view, its
// views as they are baked, what it is baked with, and what it takes.

#include "ui/model/rtt_look.h"
#include "ui/widgets/section.h"

class QLabel;

namespace prt::ui {

class BakeFooter;
class Session;

class RttDock : public DockColumn {
  Q_OBJECT
 public:
  explicit RttDock(Session& session, QWidget* parent = nullptr);

 private:
  Section* makeBake();
  void refresh();
  QString stateText() const;
  QString viewErrorText(const Rtt& rtt) const;

  Session& session_;
  RttLook look_;
  Section* square_;
  Section* views_;
  QLabel* viewText_;
  BakeFooter* footer_;
};

}  // namespace prt::ui
