#include "ui/model/light_editor.h"

#include "libprt/light/light_rig.h"
#include "libprt/light/sky_angles.h"
#include "libprt/project/lights.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

QString nameOf(const LightRecipe& light) {
  return QString::fromStdString(light.name);
}

/// A value of the light, kept within the range that the recipe's table gives it.
float inRange(double value, const char* path) {
  const Parameter& p = parameterAt(path);
  return float(std::clamp(value, p.low, p.high));
}

Rgb withoutBrightness(const Rgb& c) {
  const float most = std::max({c.x, c.y, c.z});
  return most > 0 ? c / most : Rgb(0);
}

}  // namespace

LightEditor::LightEditor(Document& document, QObject* parent) : QObject(parent), document_(document) {
  connect(&document_, &Document::opened, this, [this] { selected_ = -1; });
  connect(&document_, &Document::recipeChanged, this, &LightEditor::follow);
}

void LightEditor::follow() {
  selected_ = std::min(selected_, count() - 1);
  Q_EMIT changed();
}

std::vector<LightMark> LightEditor::marks() const {
  std::vector<LightMark> marks;
  for (int i = 0; i < count(); ++i) {
    const LightRecipe& light = lights()[std::size_t(i)];
    const bool circle = light.kind == LightKind::Circle, sun = hasSun(light) && i == environment();
    if (!circle && !sun && light.kind != LightKind::Directional) continue;
    marks.push_back({.light = i,
                     .name = nameOf(light),
                     .direction = worldDirection(light),
                     .halfAngle = circle ? float(radians(light.angle / 2)) : 0,
                     .color = sun ? Rgb(1, 0.85f, 0.5f) : withoutBrightness(light.radiance),
                     .on = light.on && light.intensity > 0,
                     .selected = i == selected_,
                     .sun = sun,
                     .resizable = circle});
  }
  return marks;
}

void LightEditor::select(int light) {
  if (!has(light)) light = -1;
  if (light == selected_) return;
  selected_ = light;
  Q_EMIT changed();
}

int LightEditor::environment() const {
  int first = -1;
  for (int i = 0; i < count(); ++i) {
    const LightRecipe& light = lights()[std::size_t(i)];
    if (light.kind != LightKind::Environment) continue;
    if (light.on && light.intensity > 0) return i;
    if (first < 0) first = i;
  }
  return first;
}

// ---- the list ----

QString LightEditor::freeName(const QString& wanted) const {
  const auto taken = [&](const QString& name) {
    return std::any_of(lights().begin(), lights().end(),
                       [&](const LightRecipe& l) { return nameOf(l) == name; });
  };
  QString base = wanted;
  while (!base.isEmpty() && (base.back().isDigit() || base.back().isSpace())) base.chop(1);
  if (base.isEmpty()) base = tr("light");
  QString name = wanted;
  for (int number = 2; taken(name); ++number) name = QStringLiteral("%1 %2").arg(base).arg(number);
  return name;
}

int LightEditor::addCircle(const Vec3& direction) {
  Recipe next = document_.recipe();
  LightRecipe& light = next.lights.emplace_back();
  light.kind = LightKind::Circle;
  light.name = freeName(tr("circle")).toStdString();
  light.direction = direction;
  light.angle = kNewAngle;
  light.radiance = Rgb(4);  // beside a sky whose level white plane looks 1
  selected_ = int(next.lights.size()) - 1;
  document_.edit(tr("Add circle light"), next);
  return selected_;
}

int LightEditor::duplicate(int light) {
  if (!has(light)) return -1;
  Recipe next = document_.recipe();
  LightRecipe copy = next.lights[std::size_t(light)];
  copy.name = freeName(nameOf(copy)).toStdString();
  if (copy.kind == LightKind::Environment) copy.on = false;  // one environment lights at a time
  if (copy.kind == LightKind::Circle || copy.kind == LightKind::Directional) {
    // Beside the other one, so that there are two to be seen.
    SkyAngles at = anglesOf(normalize(copy.direction));
    at.azimuth += radians(std::min(copy.angle, 60.0f));
    copy.direction = directionOf(at);
  }
  next.lights.insert(next.lights.begin() + light + 1, copy);
  selected_ = light + 1;
  document_.edit(tr("Duplicate %1").arg(nameOf(lights()[std::size_t(light)])), next);
  return selected_;
}

void LightEditor::remove(int light) {
  if (!has(light)) return;
  Recipe next = document_.recipe();
  const QString name = nameOf(next.lights[std::size_t(light)]);
  next.lights.erase(next.lights.begin() + light);
  if (selected_ == light)
    selected_ = -1;
  else if (selected_ > light)
    --selected_;
  document_.edit(tr("Delete %1").arg(name), next);
}

// ---- one light ----

template <class Change>
void LightEditor::edit(int light, const QString& name, Change&& change) {
  if (!has(light)) return;
  Recipe next = document_.recipe();
  change(next.lights[std::size_t(light)]);
  const bool named = name.contains(QStringLiteral("%1"));
  document_.edit(named ? name.arg(nameOf(next.lights[std::size_t(light)])) : name, next);
}

void LightEditor::aim(int light, const Vec3& direction) {
  if (!has(light) || !isFinite(direction) || direction == Vec3(0)) return;
  const bool sun = hasSun(lights()[std::size_t(light)]);
  edit(light, sun ? tr("Move sun") : tr("Move %1"), [&](LightRecipe& l) {
    // Into the frame of the light, which turns about +Y.
    const Vec3 own = transpose(environmentRotation(float(radians(l.rotation)))) * normalize(direction);
    if (l.kind != LightKind::Environment) {
      l.direction = own;
    } else if (sun) {
      const SkyAngles at = anglesOf(own);
      // Straight up every azimuth is right: keep the one there is.
      if (std::hypot(own.x, own.z) > 1e-6f) l.sunAzimuth = float(degrees(at.azimuth));
      l.sunElevation = inRange(degrees(at.elevation), "lights[].sunElevation");
    }
  });
}

void LightEditor::resize(int light, double degrees) {
  edit(light, tr("Resize %1"), [&](LightRecipe& l) { l.angle = inRange(degrees, "lights[].angle"); });
}

void LightEditor::setColor(int light, const Rgb& radiance) {
  edit(light, tr("Colour of %1"), [&](LightRecipe& l) {
    for (int c = 0; c < 3; ++c) l.radiance[c] = inRange(radiance[c], "lights[].radiance");
  });
}

void LightEditor::setIntensity(int light, double factor) {
  edit(light, tr("Intensity of %1"),
       [&](LightRecipe& l) { l.intensity = inRange(factor, "lights[].intensity"); });
}

void LightEditor::setOn(int light, bool on) {
  if (!has(light)) return;
  Recipe next = document_.recipe();
  const LightRecipe& changed = next.lights[std::size_t(light)];
  if (on && changed.kind == LightKind::Environment)  // one environment lights at a time
    for (LightRecipe& each : next.lights)
      if (each.kind == LightKind::Environment) each.on = false;
  next.lights[std::size_t(light)].on = on;
  document_.edit((on ? tr("Switch %1 on") : tr("Mute %1")).arg(nameOf(changed)), next);
}

void LightEditor::rename(int light, const QString& name) {
  if (name.trimmed().isEmpty()) return;
  edit(light, tr("Rename %1"), [&](LightRecipe& l) { l.name = name.trimmed().toStdString(); });
}

void LightEditor::setEnvironment(const QString& path) {
  Recipe next = document_.recipe();
  int index = environment();
  if (index < 0) {
    index = int(next.lights.size());
    next.lights.emplace_back().name = freeName(tr("environment")).toStdString();
  }
  LightRecipe& light = next.lights[std::size_t(index)];
  light.path = path.toStdString();
  light.mapping = "auto";
  light.on = true;
  document_.edit(tr("Change environment"), next);
}

void LightEditor::cancelDrag() {
  document_.cancelGesture();
}

}  // namespace prt::ui
