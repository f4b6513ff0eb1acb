#pragma once
// The light: which environment, how it is turned, how bright; and how the picture is exposed.

#include "ui/widgets/section.h"

class QComboBox;
class QLabel;

namespace prt::ui {

class Compass;
class MessageBar;
class NumberField;
class Panorama;
class Session;

class LightDock : public DockColumn {
  Q_OBJECT
 public:
  explicit LightDock(Session& session, QWidget* parent = nullptr);

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

 private:
  QWidget* makeProbeRow();
  QWidget* makeAngleRow();
  Section* makeViewSection();
  void loadProbe();
  void refresh();

  Session& session_;
  MessageBar* message_;
  Panorama* panorama_;
  QLabel* name_;
  Compass* compass_;
  NumberField* angle_;
  NumberField* exposure_;
  QComboBox* curve_;
  QComboBox* background_;
};

}  // namespace prt::ui
