#include "ui/model/scene_editor.h"

#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/repair.h"
#include "ui/model/scene_edits.h"
#include "ui/model/session.h"
#include "ui/model/told_path.h"

#include <QFileInfo>

#include <algorithm>

namespace prt::ui {

namespace {

constexpr float kAside = 1.1f;  // a copy beside its original, in widths of it

bool isBuiltinName(const QString& what) {
  return what.startsWith(u"builtin:");
}

}  // namespace

SceneEditor::SceneEditor(Session& session, QObject* parent) : QObject(parent), session_(session) {}

bool SceneEditor::isMesh(const QString& file) {
  const std::vector<std::string> endings = meshExtensions();
  const std::string ending = (u'.' + QFileInfo(file).suffix().toLower()).toStdString();
  return std::count(endings.begin(), endings.end(), ending) > 0;
}

QStringList SceneEditor::builtinMeshes() {
  QStringList names;
  for (const std::string& name : builtinMeshNames()) names << QString::fromStdString(name);
  return names;
}

const ObjectRecipe* SceneEditor::objectAt(int object) const {
  const auto& objects = session_.document().recipe().objects;
  return object >= 0 && object < int(objects.size()) ? &objects[std::size_t(object)] : nullptr;
}

QString SceneEditor::documentPath(const QString& file) const {
  return isBuiltinName(file) ? file : toldPath(session_.document(), file);
}

void SceneEditor::edit(const QString& name, const Recipe& next) {
  session_.document().edit(name, next);
}

void SceneEditor::append(const QStringList& paths) {
  Recipe next = session_.document().recipe();
  for (const QString& path : paths) next = withObject(std::move(next), path.toStdString());
  const QString name = paths.size() == 1
                           ? tr("Add %1").arg(QString::fromStdString(meshName(paths[0].toStdString())))
                           : tr("Add %n objects", nullptr, int(paths.size()));
  edit(name, next);
  session_.selectObject(int(next.objects.size()) - 1);
}

void SceneEditor::add(const QStringList& meshes) {
  if (meshes.isEmpty()) return;
  // Nothing is open yet: the first mesh is the scene.
  if (session_.document().recipe().objects.empty() || !session_.bakes().baker()) {
    session_.open(meshes.first());
    return;
  }
  QStringList paths, files;
  for (const QString& each : meshes) {
    paths << documentPath(each);
    if (!isBuiltinName(each)) files << QFileInfo(each).absoluteFilePath();
  }
  if (files.isEmpty()) return append(paths);
  const auto work = [files](Job& job) {
    for (const QString& file : files) loadMesh(file.toStdString(), {}, job);
  };
  const auto finish = [this, paths](const JobInfo& job) {
    if (job.state == JobState::Done) append(paths);
    if (job.state == JobState::Failed) session_.report(Severity::Error, job.error, Place::Scene);
  };
  session_.jobs().start(QStringLiteral("add"), tr("Read %1").arg(QFileInfo(files.first()).fileName()), work,
                        finish);
}

bool SceneEditor::canRemove(int object) const {
  const auto& objects = session_.document().recipe().objects;
  return objectAt(object) && objects.size() > 1 && (!visible(object) || canHide(object));
}

void SceneEditor::remove(int object) {
  const ObjectRecipe* old = objectAt(object);
  if (!old || !canRemove(object)) return;
  edit(tr("Remove %1").arg(QString::fromStdString(old->name)),
       withoutObject(session_.document().recipe(), object));
}

void SceneEditor::duplicate(int object) {
  const ObjectRecipe* old = objectAt(object);
  if (!old) return;
  const Box3 box = boundsOf(object);
  const float aside = box.empty() ? 0.0f : kAside * (box.high.x - box.low.x);
  edit(tr("Duplicate %1").arg(QString::fromStdString(old->name)),
       withDuplicate(session_.document().recipe(), object, aside));
  session_.selectObject(object + 1);
}

void SceneEditor::rename(int object, const QString& name) {
  const ObjectRecipe* old = objectAt(object);
  const QString wanted = name.simplified();
  if (!old || wanted.isEmpty()) return;
  Recipe next = session_.document().recipe();
  next.objects[std::size_t(object)].name = wanted.toStdString();
  edit(tr("Rename %1").arg(QString::fromStdString(old->name)), next);
}

bool SceneEditor::visible(int object) const {
  const ObjectRecipe* at = objectAt(object);
  return at && at->visible;
}

bool SceneEditor::canHide(int object) const {
  const auto& objects = session_.document().recipe().objects;
  const auto baked = [](const ObjectRecipe& o) { return o.visible && !o.captured; };
  return visible(object) &&
         (objects[std::size_t(object)].captured || std::count_if(objects.begin(), objects.end(), baked) > 1);
}

void SceneEditor::setVisible(int object, bool on) {
  const ObjectRecipe* old = objectAt(object);
  if (!old || old->visible == on || (!on && !canHide(object))) return;
  Recipe next = session_.document().recipe();
  next.objects[std::size_t(object)].visible = on;
  edit((on ? tr("Show %1") : tr("Hide %1")).arg(QString::fromStdString(old->name)), next);
}

void SceneEditor::restOnGround(int object) {
  const ObjectMesh found = meshOf(object);
  if (!found) return;
  const Recipe& recipe = session_.document().recipe();
  edit(tr("Rest on ground"), restingOn(recipe, object, found.mesh(), groundHeight(recipe)));
}

void SceneEditor::centre(int object) {
  const ObjectMesh found = meshOf(object);
  if (found) edit(tr("Centre"), centred(session_.document().recipe(), object, found.mesh()));
}

void SceneEditor::resize(int object, double size) {
  if (objectAt(object)) edit(tr("Size"), resized(session_.document().recipe(), object, float(size)));
}

bool SceneEditor::hasGround() const {
  return groundObject(session_.document().recipe()) >= 0;
}

void SceneEditor::setGround(bool on) {
  if (on == hasGround()) return;
  const Recipe& recipe = session_.document().recipe();
  if (!on && !canRemove(groundObject(recipe))) return;
  if (!on) return edit(tr("Remove ground plane"), withoutObject(recipe, groundObject(recipe)));
  Box3 all;
  for (int i = 0; i < int(recipe.objects.size()); ++i)
    if (const Box3 box = boundsOf(i); visible(i) && !box.empty()) all.extend(box.low), all.extend(box.high);
  edit(tr("Add ground plane"), withGround(recipe, all));
}

ObjectMesh SceneEditor::meshOf(int object) const {
  const ObjectRecipe* wanted = objectAt(object);
  const auto& product = session_.meshes();
  if (!wanted || !product) return {};
  // By what was read, not by number: objects may have been added and removed meanwhile.
  const std::vector<MeshRecipe>& read = session_.meshRecipes();
  for (std::size_t i = 0; i < read.size() && i < product->meshes.size(); ++i)
    if (read[i] == wanted->mesh) return {product, i};
  return {};
}

Box3 SceneEditor::boundsOf(int object) const {
  const ObjectMesh found = meshOf(object);
  return found ? ui::boundsOf(found.mesh(), objectAt(object)->transform.matrix()) : Box3{};
}

}  // namespace prt::ui
