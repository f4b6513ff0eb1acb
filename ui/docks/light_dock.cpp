#include "ui/docks/light_dock.h"

#include "ui/model/session.h"
#include "ui/widgets/compass.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/panorama.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QComboBox>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMimeData>
#include <QPushButton>
#include <QVBoxLayout>

namespace prt::ui {

LightDock::LightDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      message_(new MessageBar),
      panorama_(new Panorama),
      name_(new QLabel),
      compass_(new Compass),
      angle_(new NumberField({.decimals = 1, .unit = QStringLiteral("\u00b0"), .step = 5})),
      exposure_(new NumberField({.low = -10, .high = 10, .decimals = 2, .unit = tr("stops"), .step = 0.25})),
      curve_(new QComboBox),
      background_(new QComboBox) {
  setAcceptDrops(true);
  auto* environment = new Section(tr("Environment"));
  environment->add(message_);
  environment->add(panorama_);
  environment->add(makeProbeRow());
  environment->add(makeAngleRow());
  environment->add(new PropertyRow(session.document(), QStringLiteral("lights[0].intensity")));
  add(environment);
  add(makeViewSection());

  connect(panorama_, &Panorama::turned, this,
          [this](double by) { session_.setEnvironmentAngle(session_.environmentAngle() + by); });
  connect(compass_, &Compass::turned, &session_, &Session::setEnvironmentAngle);
  connect(angle_, &NumberField::edited, &session_, &Session::setEnvironmentAngle);
  connect(angle_, &NumberField::resetRequested, &session_, [this] { session_.setEnvironmentAngle(0); });
  const auto gestures = [this](auto* widget) {
    using Widget = std::remove_pointer_t<decltype(widget)>;
    connect(widget, &Widget::gestureBegan, this,
            [this] { session_.document().beginGesture(tr("Turn environment")); });
    connect(widget, &Widget::gestureEnded, this, [this] { session_.document().endGesture(); });
  };
  gestures(panorama_);
  gestures(compass_);
  gestures(angle_);
  connect(&session_.document(), &Document::recipeChanged, this, &LightDock::refresh);
  connect(&session_.relighter(), &Relighter::environmentChanged, this, [this] {
    message_->hide();
    refresh();
  });
  connect(&session_.view(), &ViewState::changed, this, &LightDock::refresh);
  connect(&session_, &Session::message, this, [this](Severity severity, const QString& text, Place place) {
    if (place == Place::Light) message_->show(severity, text);
  });
  refresh();
}

QWidget* LightDock::makeProbeRow() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, kGrid, 0, kGrid);
  layout->setSpacing(kGrid);
  name_->setObjectName(QStringLiteral("probeName"));
  name_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto* load = new QPushButton(icon(QStringLiteral("document-open")), tr("Load HDR\u2026"));
  load->setToolTip(tr("Open an HDR, EXR or PNG environment: lat-long, cross, angular map or cube strip."));
  connect(load, &QPushButton::clicked, this, &LightDock::loadProbe);
  layout->addWidget(name_, 1);
  layout->addWidget(load);
  return row;
}

QWidget* LightDock::makeAngleRow() {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, kGrid);
  layout->setSpacing(3 * kGrid);
  layout->addWidget(compass_);
  auto* right = new QVBoxLayout;
  right->setSpacing(2);
  auto* title = new QLabel(tr("Rotation"));
  setRole(title, "muted");
  angle_->setObjectName(QStringLiteral("environmentAngle"));
  angle_->setToolTip(parameterTip(parameterAt("lights[0].rotation")));
  right->addStretch(1);
  right->addWidget(title);
  right->addWidget(angle_);
  auto* hint = new QLabel(tr("or Shift+drag the view"));
  setRole(hint, "muted");
  right->addWidget(hint);
  right->addStretch(1);
  layout->addLayout(right, 1);
  return row;
}

Section* LightDock::makeViewSection() {
  auto* section = new Section(tr("View"));
  exposure_->setObjectName(QStringLiteral("exposure"));
  curve_->addItems({tr("linear"), tr("filmic")});
  background_->addItems({tr("environment"), tr("plain")});
  section->add(fieldRow(tr("Exposure"), exposure_, tr("Brightness of the picture; the light itself stays as it is.")));
  section->add(fieldRow(tr("Tone curve"), curve_, tr("How bright values are fitted to the screen: cut at white, or rolled off.")));
  section->add(fieldRow(tr("Background"), background_, tr("The environment behind the model, or plain grey.")));
  const auto setTone = [this] {
    session_.view().setTone({.exposure = float(exposure_->value()),
                             .curve = curve_->currentIndex() == 1 ? ToneCurve::Filmic : ToneCurve::Linear});
  };
  connect(exposure_, &NumberField::edited, this, setTone);
  connect(exposure_, &NumberField::resetRequested, this, [this, setTone] { exposure_->setValue(0), setTone(); });
  connect(curve_, &QComboBox::activated, this, setTone);
  connect(background_, &QComboBox::activated, this, [this](int index) {
    session_.view().setBackground(index == 0 ? BackgroundMode::Environment : BackgroundMode::Plain);
  });
  return section;
}

void LightDock::loadProbe() {
  const QString file = QFileDialog::getOpenFileName(window(), tr("Load an environment"), {},
                                                    tr("Environments (*.hdr *.exr *.png);;All files (*)"));
  if (!file.isEmpty()) session_.open(file);
}

void LightDock::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void LightDock::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) session_.open(url.toLocalFile());
}

void LightDock::refresh() {
  const auto& map = session_.relighter().environment();
  panorama_->setEnvironment(map);
  panorama_->setAngle(session_.environmentAngle());
  compass_->setAngle(session_.environmentAngle());
  angle_->setValue(session_.environmentAngle());
  for (QWidget* widget : {static_cast<QWidget*>(panorama_), static_cast<QWidget*>(compass_), static_cast<QWidget*>(angle_)})
    widget->setEnabled(session_.hasEnvironment());
  const QString path = session_.environmentFile();
  name_->setText(path.isEmpty() ? tr("no environment") : path.section(u'/', -1).remove(QStringLiteral("builtin:")));
  name_->setToolTip(path);
  exposure_->setValue(session_.view().tone().exposure);
  curve_->setCurrentIndex(session_.view().tone().curve == ToneCurve::Filmic ? 1 : 0);
  background_->setCurrentIndex(session_.view().background() == BackgroundMode::Environment ? 0 : 1);
}

}  // namespace prt::ui
