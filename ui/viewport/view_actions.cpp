#include "ui/viewport/view_actions.h"

#include "ui/model/navigation.h"
#include "ui/model/session.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/theme.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QClipboard>
#include <QMenu>
#include <QSettings>

#include <algorithm>

namespace prt::ui {

namespace {

constexpr float kExposureStep = 0.5f, kMostExposure = 20;  // stops

// Keys that a number field takes for itself.
bool typesNumbers(QKeyCombination key) {
  const Qt::Key code = key.key();
  return (code >= Qt::Key_0 && code <= Qt::Key_9) || code == Qt::Key_Plus || code == Qt::Key_Minus ||
         code == Qt::Key_Equal || code == Qt::Key_Period || code == Qt::Key_Home;
}

}  // namespace

ViewActions::ViewActions(Session& session, Viewport& viewport, bool restored, QObject* parent)
    : QObject(parent), session_(session), viewport_(viewport) {
  if (restored) restore();
  kept_ = settingsNow();
  makeCameraActions();
  makePictureActions();
  connect(&session_.view(), &ViewState::changed, this, &ViewActions::follow);
  connect(&viewport_, &Viewport::drawingChanged, this, &ViewActions::follow);
  follow();
}

QAction* ViewActions::add(const char* name, const QString& text, const QList<QKeyCombination>& keys,
                          const QString& tip, Run run) {
  auto* action = new QAction(text, this);
  action->setObjectName(QLatin1String(name));
  action->setShortcuts(QList<QKeySequence>(keys.begin(), keys.end()));
  action->setToolTip(tip);
  action->setStatusTip(tip);
  if (std::any_of(keys.begin(), keys.end(), typesNumbers))
    action->setShortcutContext(Qt::WidgetWithChildrenShortcut);
  viewport_.addAction(action);
  connect(action, &QAction::triggered, this, [run = std::move(run)] { run(); });
  return action;
}

QAction* ViewActions::addSwitch(const char* name, const QString& text, const QList<QKeyCombination>& keys,
                                const QString& tip, std::function<bool()> value,
                                std::function<void(bool)> set) {
  QAction* action = add(name, text, keys, tip, [value, set = std::move(set)] { set(!value()); });
  action->setCheckable(true);
  follow_ << [action, value] { action->setChecked(value()); };
  return action;
}

QActionGroup* ViewActions::addChoice(const char* name, const QStringList& texts, std::function<int()> value,
                                     std::function<void(int)> set) {
  auto* group = new QActionGroup(this);
  group->setObjectName(QLatin1String(name));
  for (int i = 0; i < texts.size(); ++i) {
    QAction* action = group->addAction(texts[i]);
    action->setObjectName(QStringLiteral("%1.%2").arg(QLatin1String(name)).arg(i));
    action->setCheckable(true);
    connect(action, &QAction::triggered, this, [set, i] { set(i); });
    follow_ << [action, value, i] { action->setChecked(value() == i); };
  }
  return group;
}

void ViewActions::addAxis(const char* name, const QString& text, QKeyCombination key, float x, float y,
                          float z) {
  axes_ << add(name, text, {key}, tr("Looks along an axis of the world, with parallel rays."),
               [this, x, y, z] {
                 session_.view().lookFrom(Vec3(x, y, z));
                 session_.view().setOrthographic(true);
               });
}

void ViewActions::makeCameraActions() {
  ViewState& view = session_.view();
  QAction* selected = add("frameSelected", tr("&Frame selected"), {Qt::Key_F},
                          tr("Moves the camera until the selected object fills the view."),
                          [this] { session_.frameSelected(); });
  selected->setIcon(icon(QStringLiteral("zoom-fit-best")));
  frames_ << selected;
  frames_ << add("frameAll", tr("Frame &all"), {Qt::Key_A},
                 tr("Moves the camera until everything fills the view."), [this] { session_.frameAll(); });
  frames_ << add("frameAllHome", tr("Frame all"), {Qt::Key_Home}, {}, [this] { session_.frameAll(); });
  QAction* reset = add("resetView", tr("&Reset view"), {Qt::Key_R}, tr("Back to the project's own camera."),
                       [&view] { view.reset(); });
  reset->setIcon(icon(QStringLiteral("go-home")));
  frames_ << reset;

  addAxis("front", tr("Front"), Qt::Key_1, 0, 0, 1);
  addAxis("back", tr("Back"), Qt::CTRL | Qt::Key_1, 0, 0, -1);
  addAxis("right", tr("Right"), Qt::Key_3, 1, 0, 0);
  addAxis("left", tr("Left"), Qt::CTRL | Qt::Key_3, -1, 0, 0);
  addAxis("top", tr("Top"), Qt::Key_7, 0, 1, 0);
  addAxis("bottom", tr("Bottom"), Qt::CTRL | Qt::Key_7, 0, -1, 0);
  perspective_ = addSwitch(
      "orthographic", tr("&Orthographic"), {Qt::Key_5}, tr("Parallel rays instead of perspective."),
      [&view] { return view.camera().orthographic; }, [&view](bool on) { view.setOrthographic(on); });
}

void ViewActions::makePictureActions() {
  ViewState& view = session_.view();
  backgrounds_ = addChoice(
      "background", {tr("Environment"), tr("Blurred environment"), tr("Plain")},
      [&view] { return int(view.background()); }, [&view](int i) { view.setBackground(BackgroundMode(i)); });
  shown_ << add("nextBackground", tr("Next background"), {Qt::Key_B}, tr("Environment, blurred, plain."),
                [&view] { view.setBackground(BackgroundMode((int(view.background()) + 1) % 3)); });
  shown_ << addSwitch(
      "grid", tr("&Ground grid and axes"), {Qt::Key_G},
      tr("A grid on the plane y = 0; red is +x, blue is +z."), [&view] { return view.grid(); },
      [&view](bool on) { view.setGrid(on); });
  shown_ << addSwitch(
      "compass", tr("&Compass"), {}, tr("Where the middle of the environment's map stands, seen from above."),
      [&view] { return view.compass(); }, [&view](bool on) { view.setCompass(on); });
  exposures_ << add("brighter", tr("&Brighter"), {Qt::Key_Plus, Qt::Key_Equal},
                    tr("Half a stop more exposure."), [this] { changeExposure(kExposureStep); });
  exposures_ << add("darker", tr("&Darker"), {Qt::Key_Minus}, tr("Half a stop less exposure."),
                    [this] { changeExposure(-kExposureStep); });
  exposures_ << add("exposureZero", tr("Exposure &0"), {Qt::Key_0}, tr("Exposure back to 0 stops."),
                    [this] { changeExposure(-session_.view().tone().exposure); });
  curves_ = addChoice(
      "curve", {tr("Linear"), tr("Filmic")}, [&view] { return int(view.tone().curve); },
      [&view](int i) {
        ToneSettings tone = view.tone();
        tone.curve = ToneCurve(i);
        view.setTone(tone);
      });
  QStringList names;
  for (const NavigationPreset preset : navigationPresets()) names << nameOf(preset);
  presets_ = addChoice(
      "navigation", names, [&view] { return int(navigationPresets().indexOf(view.navigation())); },
      [&view](int i) { view.setNavigation(navigationPresets()[i]); });
  drawings_ = addChoice(
      "drawing", {tr("Automatic"), tr("OpenGL"), tr("CPU")}, [this] { return int(viewport_.drawing()); },
      [this](int i) { viewport_.setDrawing(Drawing(i)); });
  copy_ = add("copyPicture", tr("&Copy picture"), {},
              tr("The picture without what is written on it, to the clipboard."), [this] { copyPicture(); });
  copy_->setIcon(icon(QStringLiteral("edit-copy")));
}

void ViewActions::changeExposure(float stops) {
  ToneSettings tone = session_.view().tone();
  tone.exposure = std::clamp(tone.exposure + stops, -kMostExposure, kMostExposure);
  session_.view().setTone(tone);
}

void ViewActions::copyPicture() {
  const QImage picture = viewport_.canvas().grabPicture();
  if (!picture.isNull()) QApplication::clipboard()->setImage(picture);
}

void ViewActions::addSubmenu(QMenu& menu, const QString& title, const QList<QAction*>& actions) {
  QMenu* submenu = menu.addMenu(title);
  submenu->setToolTipsVisible(true);
  submenu->addActions(actions);
}

void ViewActions::fillViewMenu(QMenu& menu) {
  menu.setToolTipsVisible(true);
  for (QAction* action : frames_)
    if (action->objectName() != u"frameAllHome") menu.addAction(action);
  addSubmenu(menu, tr("&Axis views"), axes_);
  menu.addAction(perspective_);
  menu.addSeparator();
  addSubmenu(menu, tr("&Background"), backgrounds_->actions() << shown_[0]);
  QMenu* exposure = menu.addMenu(tr("&Exposure"));
  exposure->setToolTipsVisible(true);
  exposure->addActions(exposures_);
  exposure->addSeparator();
  exposure->addActions(curves_->actions());
  menu.addActions(shown_.mid(1));
  addSubmenu(menu, tr("&Navigation"), presets_->actions());
  addSubmenu(menu, tr("&Drawing"), drawings_->actions());
  menu.addAction(copy_);
}

void ViewActions::fillContextMenu(QMenu& menu) {
  menu.addAction(frames_[0]);
  menu.addAction(frames_[1]);
  menu.addAction(frames_.back());
  menu.addSeparator();
  addSubmenu(menu, tr("&Background"), backgrounds_->actions());
  addSubmenu(menu, tr("&Drawing"), drawings_->actions());
  menu.addActions(shown_.mid(1));
  menu.addAction(perspective_);
  menu.addSeparator();
  menu.addAction(copy_);
}

void ViewActions::restore() {
  QSettings settings;
  settings.beginGroup(QStringLiteral("viewport"));
  ViewState& view = session_.view();
  const auto number = [&](const char* key, int most, int otherwise) {
    return std::clamp(settings.value(QLatin1String(key), otherwise).toInt(), 0, most);
  };
  view.setNavigation(navigationPreset(settings.value(QStringLiteral("navigation")).toString()));
  view.setBackground(BackgroundMode(number("background", 2, int(view.background()))));
  view.setGrid(settings.value(QStringLiteral("grid"), view.grid()).toBool());
  view.setCompass(settings.value(QStringLiteral("compass"), view.compass()).toBool());
  viewport_.setDrawing(Drawing(number("drawing", 2, int(viewport_.drawing()))));
}

QVariantMap ViewActions::settingsNow() const {
  const ViewState& view = session_.view();
  return {{QStringLiteral("navigation"), nameOf(view.navigation())},
          {QStringLiteral("background"), int(view.background())},
          {QStringLiteral("grid"), view.grid()},
          {QStringLiteral("compass"), view.compass()},
          {QStringLiteral("drawing"), int(viewport_.drawing())}};
}

// Check marks say what is; what was changed is kept for the next time. Runs at every move of the camera.
void ViewActions::follow() {
  for (const Run& each : follow_) each();
  const QVariantMap now = settingsNow();
  if (now == kept_) return;
  QSettings settings;
  settings.beginGroup(QStringLiteral("viewport"));
  for (auto each = now.begin(); each != now.end(); ++each)
    if (kept_.value(each.key()) != each.value()) settings.setValue(each.key(), each.value());
  kept_ = now;
}

}  // namespace prt::ui
