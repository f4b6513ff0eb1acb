#pragma once
// The light: which environment, how it is turned and how bright; the lights beside it; and how the picture is
// exposed.

#include "ui/widgets/section.h"

class QComboBox;
class QLabel;

namespace prt::ui {

class Compass;
class LightList;
class MessageBar;
class NumberField;
class Panorama;
class ProbeStrip;
class Session;

class LightDock : public DockColumn {
  Q_OBJECT
 public:
  explicit LightDock(Session& session, QWidget* parent = nullptr);

 protected:
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void makeEnvironmentSection();
  QWidget* makeProbeRow();
  QWidget* makeAngleRow();
  Section* makeListSection();
  Section* makeViewSection();
  void connectAngle();
  void connectProbes();
  void loadProbe();
  void refresh();
  void refreshRows();

  Session& session_;
  MessageBar* message_;
  Panorama* panorama_;
  ProbeStrip* probes_;
  LightList* list_;
  QLabel* name_;
  Compass* compass_;
  NumberField* angle_;
  QWidget* environmentRows_;  // holds the rows of the environment that lights
  Section* lightSection_;     // the selected light, when it is another one
  QWidget* lightRows_;
  QString shownEnvironment_, shownLight_;  // what the rows are made for
  NumberField* exposure_;
  QComboBox* curve_;
  QComboBox* background_;
};

}  // namespace prt::ui
