#include "ui/model/wish_editor.h"

#include "libprt/project/synthesis_stages.h"
#include "ui/model/session.h"

#include <algorithm>

namespace prt::ui {

WishEditor::WishEditor(Session& session, QObject* parent)
    : SpotEditor(session, Brush::Wishes, MarkOwner::Wishes, parent) {}

void WishEditor::setPart(const Vec2& place, float extent) {
  place_ = place - glm::floor(place);
  extent_ = std::clamp(extent, kLeastExtent, kMostExtent);
  Q_EMIT changed();
}

void WishEditor::read() {
  wishes_.clear();
  wishes_ = parseWishes(session().document().recipe().synthesis.wishes);
}

std::vector<WishEditor::ShownSpot> WishEditor::spots() const {
  std::vector<ShownSpot> out;
  for (const PatchWish& wish : wishes()) out.push_back({wish.centre, wish.radius, colorOfPart(wish.place)});
  return out;
}

void WishEditor::paintAt(const std::vector<Vec3>& centres) {
  dragged_ = paintedOver(wishes_, {.radius = radius(), .place = place_, .extent = extent_}, centres);
}

void WishEditor::finishDrag(bool takesAway) {
  Recipe next = session().document().recipe();
  next.synthesis.wishes = wishesToText(dragged_);
  session().document().edit(takesAway ? tr("Erase wishes") : tr("Paint wish"), next);
}

void WishEditor::eraseAll() {
  Recipe next = session().document().recipe();
  next.synthesis.wishes.clear();
  session().document().edit(tr("Erase all wishes"), next);
}

}  // namespace prt::ui
