#include "ui/model/layer_editor.h"

#include "libprt/project/synthesis_stages.h"
#include "ui/model/session.h"

#include <algorithm>
#include <utility>

namespace prt::ui {

namespace {

QString nameOf(const Recipe& recipe, int layer) {
  const QString name = QString::fromStdString(recipe.layers[std::size_t(layer)].name);
  return name.isEmpty() ? QObject::tr("layer %1").arg(layer + 1) : name;
}

}  // namespace

const PatchOptions& patchOf(const Recipe& recipe, int layer) {
  const bool there = layer >= 0 && std::size_t(layer) < recipe.layers.size();
  return there ? recipe.layers[std::size_t(layer)].patch : recipe.patch;
}
PatchOptions& patchOf(Recipe& recipe, int layer) {
  return const_cast<PatchOptions&>(patchOf(std::as_const(recipe), layer));
}

LayerEditor::LayerEditor(Session& session, QObject* parent)
    : SpotEditor(session, Brush::Layers, MarkOwner::Layers, parent) {
  connect(&session.document(), &Document::opened, this, [this] { select(kPatch); });
}

void LayerEditor::select(int layer) {
  const int next = std::clamp(layer, kPatch, count() - 1);
  if (next == selected_) return;
  if (painting()) drop();
  selected_ = next;
  if (selected_ == kPatch && session().painting().brush() == Brush::Layers)
    session().painting().take(Brush::None);
  tell();
}

QString LayerEditor::patchPath() const {
  return selected_ == kPatch ? QStringLiteral("patch") : QStringLiteral("layers[%1].patch").arg(selected_);
}

bool LayerEditor::canAdd() const {
  const Recipe& recipe = session().document().recipe();
  return recipe.patch.model != PatchModel::None && recipe.layers.size() < std::size_t(kMostLayers);
}

void LayerEditor::add() {
  if (!canAdd()) return;
  Recipe next = session().document().recipe();
  LayerRecipe& layer = next.layers.emplace_back();
  layer.name = tr("layer %1").arg(next.layers.size()).toStdString();
  // Something else than what is below, so that one sees it.
  layer.patch.model =
      next.patch.model == PatchModel::HeightField ? PatchModel::Weave : PatchModel::HeightField;
  const int added = int(next.layers.size()) - 1;
  session().document().edit(tr("Add layer"), next);
  select(added);
}

void LayerEditor::remove(int layer) {
  if (layer < 0 || layer >= count()) return;
  Recipe next = session().document().recipe();
  const QString name = nameOf(next, layer);
  next.layers.erase(next.layers.begin() + layer);
  session().document().edit(tr("Remove %1").arg(name), next);
}

void LayerEditor::rename(int layer, const QString& name) {
  if (layer < 0 || layer >= count() || name.trimmed().isEmpty()) return;
  session().document().set(QStringLiteral("layers[%1].name").arg(layer), name.trimmed());
}

void LayerEditor::eraseAll() {
  if (selected_ == kPatch) return;
  write(tr("Uncover %1").arg(nameOf(session().document().recipe(), selected_)), {});
}

void LayerEditor::setStrength(float strength) {
  strength_ = std::clamp(strength, kLeastStrength, 1.0f);
  Q_EMIT changed();
}

const std::vector<LayerSpot>& LayerEditor::spotsOf(int layer) const {
  return painting() && layer == selected_ ? dragged_ : spots_[std::size_t(layer)];
}

void LayerEditor::read() {
  const std::vector<LayerRecipe>& layers = session().document().recipe().layers;
  spots_.assign(layers.size(), {});
  selected_ = std::min(selected_, count() - 1);
  for (std::size_t i = 0; i < layers.size(); ++i) spots_[i] = parseSpots(layers[i].spots);
}

std::vector<LayerEditor::ShownSpot> LayerEditor::spots() const {
  std::vector<ShownSpot> out;
  for (int layer = 0; layer < count(); ++layer)
    for (const LayerSpot& spot : spotsOf(layer))
      out.push_back({spot.centre, spot.radius, colorOfLayer(layer)});
  return out;
}

void LayerEditor::paintAt(const std::vector<Vec3>& centres) {
  const LayerSpot brush{.radius = radius(), .strength = strength_};
  dragged_ = paintedOver(spots_[std::size_t(selected_)], brush, centres);
}

void LayerEditor::finishDrag(bool takesAway) {
  if (selected_ == kPatch) return;  // it went while it was painted
  const QString name = nameOf(session().document().recipe(), selected_);
  write(takesAway ? tr("Erase %1").arg(name) : tr("Paint %1").arg(name), dragged_);
}

void LayerEditor::write(const QString& name, const std::vector<LayerSpot>& spots) {
  Recipe next = session().document().recipe();
  next.layers[std::size_t(selected_)].spots = spotsToText(spots);
  session().document().edit(name, next);
}

}  // namespace prt::ui
