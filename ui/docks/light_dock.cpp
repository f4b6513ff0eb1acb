#include "ui/docks/light_dock.h"

#include "libprt/project/lights.h"
#include "ui/model/session.h"
#include "ui/widgets/compass.h"
#include "ui/widgets/light_list.h"
#include "ui/widgets/message_bar.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/panorama.h"
#include "ui/widgets/probe_strip.h"
#include "ui/widgets/property_row.h"
#include "ui/widgets/theme.h"

#include <QComboBox>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>
#include <QToolButton>
#include <QVBoxLayout>

namespace prt::ui {

namespace {

const QString kRecentProbes = QStringLiteral("probes/recent");

/// The parameters that matter for a light of this kind, beside the environment's angle, which has a compass.
QStringList rowsOf(const LightRecipe& light) {
  QStringList rows;
  switch (light.kind) {
    case LightKind::Environment:
      rows << QStringLiteral("intensity");
      if (hasSun(light)) rows << QStringLiteral("sunAzimuth") << QStringLiteral("sunElevation");
      return rows;
    case LightKind::Circle:
      rows << QStringLiteral("angle");
      break;
    case LightKind::Directional:
    case LightKind::Constant:
      break;
  }
  rows << QStringLiteral("radiance") << QStringLiteral("intensity");
  if (light.kind != LightKind::Constant) rows << QStringLiteral("direction");
  return rows;
}

QToolButton* toolButton(const QString& iconName, const QString& text, const QString& tip) {
  auto* button = new QToolButton;
  button->setIcon(icon(iconName));
  button->setText(text);
  button->setToolButtonStyle(text.isEmpty() ? Qt::ToolButtonIconOnly : Qt::ToolButtonTextBesideIcon);
  button->setToolTip(tip);
  return button;
}

/// An empty column for rows.
QWidget* column() {
  auto* holder = new QWidget;
  auto* layout = new QVBoxLayout(holder);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  return holder;
}

/// What fits the narrow dock; empty: the parameter's own title.
QString shortTitle(const QString& parameter) {
  if (parameter == u"sunAzimuth") return QObject::tr("Sun around");
  if (parameter == u"sunElevation") return QObject::tr("Sun height");
  return {};
}

/// Puts the rows of a light into a column, in place of what is there.
void fill(QWidget* holder, Document& document, int light) {
  qDeleteAll(holder->findChildren<PropertyRow*>(Qt::FindDirectChildrenOnly));
  if (light < 0) return;
  for (const QString& name : rowsOf(document.recipe().lights[std::size_t(light)]))
    holder->layout()->addWidget(
        new PropertyRow(document, QStringLiteral("lights[%1].%2").arg(light).arg(name), shortTitle(name)));
}

/// Changes when other rows are needed.
QString rowsKey(const LightEditor& lights, int light) {
  if (light < 0) return {};
  return QString::number(light) + rowsOf(lights.lights()[std::size_t(light)]).join(u' ');
}

}  // namespace

LightDock::LightDock(Session& session, QWidget* parent)
    : DockColumn(parent),
      session_(session),
      message_(new MessageBar),
      panorama_(new Panorama(session.lights())),
      probes_(new ProbeStrip(session.probes())),
      list_(new LightList(session.lights())),
      name_(new QLabel),
      compass_(new Compass),
      angle_(new NumberField({.decimals = 1, .unit = QStringLiteral("\u00b0"), .step = 5})),
      environmentRows_(column()),
      lightSection_(new Section(tr("Light"))),
      lightRows_(column()),
      exposure_(new NumberField({.low = -10, .high = 10, .decimals = 2, .unit = tr("stops"), .step = 0.25})),
      curve_(new QComboBox),
      background_(new QComboBox) {
  setAcceptDrops(true);
  makeEnvironmentSection();
  add(makeListSection());
  lightSection_->add(lightRows_);
  add(lightSection_);
  add(makeViewSection());
  connectAngle();
  connectProbes();
  connect(&session_.document(), &Document::recipeChanged, this, &LightDock::refresh);
  connect(&session_.lights(), &LightEditor::changed, this, &LightDock::refreshRows);
  connect(&session_.relighter(), &Relighter::environmentChanged, this, [this] {
    message_->hide();
    refresh();
  });
  connect(&session_.view(), &ViewState::changed, this, &LightDock::refresh);
  connect(&session_, &Session::message, this, [this](Severity severity, const QString& text, Place place) {
    if (place == Place::Light) message_->show(severity, text);
  });
  refresh();
  refreshRows();
}

void LightDock::makeEnvironmentSection() {
  auto* section = new Section(tr("Environment"));
  section->add(message_);
  section->add(panorama_);
  section->add(makeProbeRow());
  section->add(probes_);
  section->add(makeAngleRow());
  section->add(environmentRows_);
  add(section);
}

void LightDock::connectAngle() {
  connect(panorama_, &Panorama::turned, this,
          [this](double by) { session_.setEnvironmentAngle(session_.environmentAngle() + by); });
  connect(panorama_, &Panorama::colorWanted, list_, &LightList::pickColor);
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
}

void LightDock::connectProbes() {
  session_.probes().setRecent(QSettings().value(kRecentProbes).toStringList());
  connect(&session_.probes(), &ProbeLibrary::recentChanged, this,
          [this] { QSettings().setValue(kRecentProbes, session_.probes().recent()); });
  connect(probes_, &ProbeStrip::chosen, &session_, &Session::useEnvironment);
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
  angle_->setToolTip(parameterTip(parameterAt("lights[0].rotation")) +
                     tr("<p>Shift + drag in the view turns it too.</p>"));
  right->addStretch(1);
  right->addWidget(title);
  right->addWidget(angle_);
  right->addStretch(1);
  layout->addLayout(right, 1);
  return row;
}

Section* LightDock::makeListSection() {
  auto* section = new Section(tr("Lights"));
  section->add(list_);
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGrid);
  LightEditor& lights = session_.lights();
  auto* addCircle =
      toolButton(QStringLiteral("list-add"), tr("Circle light"),
                 tr("Add a disc of light above the camera. A double click on the panorama puts one there."));
  auto* copy = toolButton(QStringLiteral("edit-duplicate"), {}, tr("Duplicate the selected light."));
  auto* remove = toolButton(QStringLiteral("edit-delete"), {}, tr("Delete the selected light."));
  addCircle->setObjectName(QStringLiteral("addCircleLight"));
  copy->setObjectName(QStringLiteral("duplicateLight"));
  remove->setObjectName(QStringLiteral("deleteLight"));
  connect(addCircle, &QToolButton::clicked, this, [this] {
    const Frame axes = session_.view().camera().axes();
    session_.lights().addCircle(normalize(axes.normal + axes.tangent + 1.2f * Vec3(0, 1, 0)));
  });
  connect(copy, &QToolButton::clicked, this, [&lights] { lights.duplicate(lights.selected()); });
  connect(remove, &QToolButton::clicked, this, [&lights] { lights.remove(lights.selected()); });
  const auto enable = [&lights, copy, remove] {
    copy->setEnabled(lights.selected() >= 0);
    remove->setEnabled(lights.selected() >= 0);
  };
  connect(&lights, &LightEditor::changed, this, enable);
  enable();
  layout->addWidget(addCircle);
  layout->addStretch(1);
  layout->addWidget(copy);
  layout->addWidget(remove);
  section->add(row);
  return section;
}

Section* LightDock::makeViewSection() {
  auto* section = new Section(tr("View"));
  exposure_->setObjectName(QStringLiteral("exposure"));
  curve_->addItems({tr("linear"), tr("filmic")});
  background_->addItems({tr("environment"), tr("blurred"), tr("plain")});  // as BackgroundMode
  section->add(
      fieldRow(tr("Exposure"), exposure_, tr("Brightness of the picture; the light itself stays as it is.")));
  section->add(fieldRow(tr("Tone curve"), curve_,
                        tr("How bright values are fitted to the screen: cut at white, or rolled off.")));
  section->add(fieldRow(tr("Background"), background_,
                        tr("The environment behind the model, sharp or blurred, or plain grey.")));
  const auto setTone = [this] {
    session_.view().setTone({.exposure = float(exposure_->value()),
                             .curve = curve_->currentIndex() == 1 ? ToneCurve::Filmic : ToneCurve::Linear});
  };
  connect(exposure_, &NumberField::edited, this, setTone);
  connect(exposure_, &NumberField::resetRequested, this,
          [this, setTone] { exposure_->setValue(0), setTone(); });
  connect(curve_, &QComboBox::activated, this, setTone);
  connect(background_, &QComboBox::activated, this,
          [this](int index) { session_.view().setBackground(BackgroundMode(index)); });
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

// Pictures of environments are made once somebody can see them.
void LightDock::showEvent(QShowEvent* event) {
  DockColumn::showEvent(event);
  session_.probes().wantPictures();
}

void LightDock::refreshRows() {
  const LightEditor& lights = session_.lights();
  const int environment = lights.environment(), selected = lights.selected();
  if (const QString key = rowsKey(lights, environment); key != shownEnvironment_) {
    shownEnvironment_ = key;
    fill(environmentRows_, session_.document(), environment);
  }
  const bool another = selected >= 0 && selected != environment;
  if (const QString key = another ? rowsKey(lights, selected) : QString(); key != shownLight_) {
    shownLight_ = key;
    fill(lightRows_, session_.document(), another ? selected : -1);
  }
  lightSection_->setVisible(another);
  if (another) lightSection_->setTitle(QString::fromStdString(lights.lights()[std::size_t(selected)].name));
}

void LightDock::refresh() {
  const auto& map = session_.relighter().environment();
  panorama_->setEnvironment(map);
  panorama_->setAngle(session_.environmentAngle());
  compass_->setAngle(session_.environmentAngle());
  angle_->setValue(session_.environmentAngle());
  probes_->setCurrent(session_.environmentPath());
  for (QWidget* widget : {static_cast<QWidget*>(compass_), static_cast<QWidget*>(angle_)})
    widget->setEnabled(session_.hasEnvironment());
  const QString path = session_.environmentFile();
  name_->setText(path.isEmpty() ? tr("no environment")
                                : path.section(u'/', -1).remove(QStringLiteral("builtin:")));
  name_->setToolTip(path);
  exposure_->setValue(session_.view().tone().exposure);
  curve_->setCurrentIndex(session_.view().tone().curve == ToneCurve::Filmic ? 1 : 0);
  background_->setCurrentIndex(int(session_.view().background()));
}

}  // namespace prt::ui
