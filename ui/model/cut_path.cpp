#include "ui/model/cut_path.h"

#include <algorithm>

namespace prt::ui {

namespace {
constexpr float kAgain = 1e4f;  // times as dear: a loop does not go back the way it came
}  // namespace

CutSurface::CutSurface(std::shared_ptr<const Scene> from, float creases, Job& job)
    : scene(std::move(from)), surface(scene->mesh, job) {
  alongCreases = seamCosts(surface, {.followCreases = creases, .concaveBonus = 0.2 * creases}, job);
  lengths = seamCosts(surface, {.followCreases = 0, .concaveBonus = 0}, job);
}

void CutPath::begin(std::uint32_t vertex) {
  clear();
  places_ = {vertex};
}

void CutPath::clear() {
  places_.clear();
  legs_.clear();
  paths_.reset();
}

std::vector<std::uint32_t> CutPath::wayTo(std::uint32_t vertex, bool followCreases, Job& job) {
  if (empty() || vertex == last()) return {};
  const std::span<const float> costs = on_->costs(followCreases);
  if (closes(vertex)) {
    std::vector<float> dear(costs.begin(), costs.end());
    for (const auto& leg : legs_)
      for (const std::uint32_t e : leg) dear[e] *= kAgain;
    SurfacePaths round(on_->surface, dear);
    round.startFrom(last());
    return round.pathTo(vertex, job);
  }
  if (!paths_ || pathsFollow_ != followCreases) {
    paths_ = std::make_unique<SurfacePaths>(on_->surface, costs);
    paths_->startFrom(last());
    pathsFollow_ = followCreases;
  }
  return paths_->pathTo(vertex, job);
}

void CutPath::add(const std::vector<std::uint32_t>& way) {
  std::vector<std::uint32_t> edges;
  for (std::size_t i = 1; i < way.size(); ++i) edges.push_back(on_->surface.edgeBetween(way[i - 1], way[i]));
  legs_.push_back(std::move(edges));
  places_.push_back(way.back());
  paths_.reset();
}

void CutPath::follow(const Seams& seams) {
  const auto cut = [&](const std::vector<std::uint32_t>& leg) {
    return std::all_of(leg.begin(), leg.end(), [&](std::uint32_t e) { return seams[e]; });
  };
  while (!legs_.empty() && !cut(legs_.back())) {
    legs_.pop_back();
    places_.pop_back();
    paths_.reset();
  }
}

}  // namespace prt::ui
