#include "ui/model/document.h"

#include <utility>

namespace prt::ui {

Document::Document(QObject* parent) : QObject(parent) {}

QString Document::title() const {
  if (!path_.isEmpty()) return path_.section(u'/', -1);
  if (recipe_.objects.empty()) return {};
  return QString::fromStdString(recipe_.objects.front().mesh.path).section(u'/', -1).section(u':', -1);
}

void Document::open(Recipe recipe, const QString& path) {
  recipe_ = saved_ = std::move(recipe);
  path_ = path;
  undo_.clear();
  redo_.clear();
  gestureDepth_ = 0;
  gestureStart_.reset();
  Q_EMIT opened();
  Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::markSaved(const QString& path, const Recipe& saved) {
  path_ = path;
  const bool moved = saved != recipe_;
  recipe_ = saved_ = saved;
  if (moved) {
    undo_.clear();
    redo_.clear();
    Q_EMIT recipeChanged();
  }
  Q_EMIT stateChanged();
}

void Document::edit(const QString& name, const Recipe& next) {
  if (next == recipe_) return;
  if (!inGesture()) remember(name, recipe_);
  recipe_ = next;
  Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::set(const QString& path, const QString& value) {
  Recipe next = recipe_;
  setByPath(next, path.toStdString(), value.toStdString());
  edit(parameterTitle(path), next);
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
  if (before == recipe_) return;
  recipe_ = before;
  Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::undo() {
  if (!canUndo() || inGesture()) return;
  Step step = std::move(undo_.back());
  undo_.pop_back();
  std::swap(recipe_, step.recipe);
  redo_.push_back(std::move(step));
  Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::redo() {
  if (!canRedo() || inGesture()) return;
  Step step = std::move(redo_.back());
  redo_.pop_back();
  std::swap(recipe_, step.recipe);
  undo_.push_back(std::move(step));
  Q_EMIT recipeChanged();
  Q_EMIT stateChanged();
}

void Document::remember(const QString& name, const Recipe& before) {
  undo_.push_back({name, before});
  if (undo_.size() > kMaxUndo) undo_.erase(undo_.begin());
  redo_.clear();
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

}  // namespace prt::ui
