#include "ui/model/document.h"

#include "libprt/project/linked_files.h"

#include <algorithm>
#include <utility>

namespace prt::ui {

Document::Document(QObject* parent) : QObject(parent) {}

QString Document::title() const {
  if (!path_.isEmpty()) return path_.section(u'/', -1);
  if (recipe_.objects.empty()) return {};
  return QString::fromStdString(recipe_.objects.front().mesh.path).section(u'/', -1).section(u':', -1);
}

std::filesystem::path Document::folder() const {
  return path_.isEmpty() ? std::filesystem::path("/")
                         : std::filesystem::path(path_.toStdString()).parent_path();
}

void Document::open(Recipe recipe, const QString& path) {
  recipe_ = saved_ = std::move(recipe);
  path_ = path;
  undo_.clear();
  redo_.clear();
  savedDepth_ = 0;
  gestureDepth_ = 0;
  gestureStart_.reset();
  Q_EMIT opened();
  Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

Recipe Document::movedTo(const QString& path, Recipe recipe) const {
  makePathsRelative(recipe, folder(), std::filesystem::path(path.toStdString()).parent_path());
  return recipe;
}

void Document::markSaved(const QString& path, const Recipe& saved) {
  saved_ = movedTo(path, saved);
  Recipe moved = movedTo(path, recipe_);
  for (auto* steps : {&undo_, &redo_})
    for (Step& step : *steps) step.recipe = movedTo(path, std::move(step.recipe));
  if (gestureStart_) gestureStart_ = movedTo(path, std::move(*gestureStart_));
  const bool pathsChanged = moved != recipe_;
  path_ = path;
  recipe_ = std::move(moved);
  savedDepth_ = int(undo_.size());
  if (pathsChanged) Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::edit(const QString& name, const Recipe& next) {
  if (next == recipe_) return;
  if (!inGesture()) remember(name, recipe_);
  recipe_ = next;
  Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::set(const QString& path, const QString& value, const QString& title) {
  Recipe next = recipe_;
  setByPath(next, path.toStdString(), value.toStdString());
  edit(editName(next, path, title), next);
}

void Document::beginGesture(const QString& name) {
  if (gestureDepth_++ > 0) return;
  gestureName_ = name;
  gestureStart_ = recipe_;
}

void Document::endGesture() {
  if (gestureDepth_ == 0 || --gestureDepth_ > 0) return;
  const Recipe before = std::move(*gestureStart_);
  gestureStart_.reset();
  if (before != recipe_) remember(gestureName_, before);
  Q_EMIT stateChanged();
}

void Document::cancelGesture() {
  if (!inGesture()) return;
  gestureDepth_ = 0;
  const Recipe before = std::move(*gestureStart_);
  gestureStart_.reset();
  const bool changed = before != recipe_;
  recipe_ = before;
  if (changed) Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::swapWith(std::vector<Step>& from, std::vector<Step>& to) {
  Step step = std::move(from.back());
  from.pop_back();
  std::swap(recipe_, step.recipe);
  to.push_back(std::move(step));
}

void Document::undo() {
  step(-1);
}

void Document::redo() {
  step(1);
}

void Document::step(int steps) {
  if (inGesture()) return;
  bool moved = false;
  for (; steps < 0 && canUndo(); ++steps, moved = true) swapWith(undo_, redo_);
  for (; steps > 0 && canRedo(); --steps, moved = true) swapWith(redo_, undo_);
  if (!moved) return;
  Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::remember(const QString& name, const Recipe& before) {
  if (savedDepth_ > int(undo_.size())) savedDepth_ = -1;  // the way to the saved state is given up
  undo_.push_back({name, before});
  redo_.clear();
  std::size_t bytes = 0;
  auto keep = undo_.rbegin();
  for (int steps = 0; keep != undo_.rend() && steps < kMaxUndo; ++keep, ++steps) {
    bytes += bytesOf(keep->recipe);
    if (bytes > kMaxUndoBytes && steps > 0) break;
  }
  const auto gone = undo_.rend() - keep;
  undo_.erase(undo_.begin(), undo_.begin() + gone);
  savedDepth_ = std::max(-1, savedDepth_ - int(gone));
}

QStringList Document::undoNames() const {
  QStringList names;
  for (const Step& step : undo_) names << step.name;
  return names;
}

QStringList Document::redoNames() const {
  QStringList names;
  for (auto step = redo_.rbegin(); step != redo_.rend(); ++step) names << step->name;
  return names;
}

QStringList Document::editsSinceSave() const {
  if (!modified()) return {};
  const int depth = int(undo_.size());
  if (savedDepth_ > depth) {
    QStringList undone;
    for (const QString& name : redoNames().mid(0, savedDepth_ - depth)) undone << tr("Undo %1").arg(name);
    return undone;
  }
  return undoNames().mid(std::max(0, savedDepth_));
}

QString parameterTitle(const QString& path) {
  QString name = path.section(u'.', -1);
  QString spaced;
  for (const QChar c : name) {
    if (c.isUpper() && !spaced.isEmpty()) spaced += u' ';
    spaced += c.toLower();
  }
  if (!spaced.isEmpty()) spaced[0] = spaced[0].toUpper();
  return spaced;
}

QString editName(const Recipe& recipe, const QString& path, const QString& called) {
  const QString title = called.isEmpty() ? parameterTitle(path) : called;
  const auto named = [&](const auto& list, const char* array, const QString& kind) -> QString {
    const QString head = QLatin1String(array) + u'[';
    if (!path.startsWith(head)) return {};
    const auto index = path.mid(head.size()).section(u']', 0, 0).toUInt();
    if (index >= list.size()) return {};
    const QString name = QString::fromStdString(list[index].name);
    return QObject::tr("%1 of %2")
        .arg(title, name.isEmpty() ? QStringLiteral("%1 %2").arg(kind).arg(index + 1) : name);
  };
  for (const char* shortForm : {"mesh", "transform", "material"})
    if (path.section(u'.', 0, 0) == QLatin1String(shortForm))
      return editName(recipe, QStringLiteral("objects[0].") + path, called);
  for (const QString& name : {named(recipe.objects, "objects", QObject::tr("object")),
                              named(recipe.lights, "lights", QObject::tr("light")),
                              named(recipe.cameras, "cameras", QObject::tr("camera")),
                              named(recipe.layers, "layers", QObject::tr("layer"))})
    if (!name.isEmpty()) return name;
  return title;
}

std::size_t bytesOf(const Recipe& recipe) {
  std::size_t bytes = sizeof(Recipe);
  for (const ObjectRecipe& o : recipe.objects)
    bytes += sizeof o + o.name.capacity() + o.mesh.path.capacity() + o.material.name.capacity() +
             o.seams.capacity() + o.charts.capacity();
  for (const LightRecipe& l : recipe.lights)
    bytes += sizeof l + l.name.capacity() + l.path.capacity() + l.mapping.capacity();
  for (const CameraRecipe& c : recipe.cameras) bytes += sizeof c + c.name.capacity();
  for (const LayerRecipe& l : recipe.layers) bytes += sizeof l + l.name.capacity() + l.spots.capacity();
  return bytes + recipe.method.name.capacity() + recipe.method.window.capacity();
}

}  // namespace prt::ui
