#include "libprt/atlas/seams.h"

#include "libprt/core/error.h"
#include "libprt/mesh/cancel_check.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace prt {
namespace {

std::vector<std::uint32_t> seamSpokes(const Surface& surface, const Seams& seams, std::uint32_t vertex) {
  std::vector<std::uint32_t> cut;
  for (std::uint32_t i = surface.spokeStart[vertex]; i < surface.spokeStart[vertex + 1]; ++i)
    if (seams[surface.spokes[i]]) cut.push_back(surface.spokes[i]);
  return cut;
}

/// Appends the edges that follow `edge` beyond `vertex` while the cut neither ends nor forks.
void follow(const Surface& surface, const Seams& seams, std::uint32_t edge, std::uint32_t vertex,
            std::vector<std::uint32_t>& chain) {
  const std::uint32_t first = edge;
  while (true) {
    const std::vector<std::uint32_t> cut = seamSpokes(surface, seams, vertex);
    if (cut.size() != 2) return;
    edge = cut[0] == edge ? cut[1] : cut[0];
    if (edge == first) return;  // all the way round
    chain.push_back(edge);
    vertex = surface.across(edge, vertex);
  }
}

[[noreturn]] void badText(const std::string& text, std::size_t at) {
  throw ValueError(
      "seams are vertex numbers parted by spaces, chains parted by ';', not '" + text.substr(at, 12) + "'",
      "charts.seams", "draw the cut anew");
}

std::uint32_t readNumber(const std::string& text, std::size_t& at) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), number);
  if (error != std::errc()) badText(text, at);
  at = std::size_t(end - text.data());
  return number;
}

/// The edge between two vertices of the mesh, whichever fans they are of.
std::uint32_t edgeOfMesh(const Surface& surface, std::uint32_t a, std::uint32_t b) {
  if (a < surface.vertexOfMesh.size() && b < surface.vertexOfMesh.size()) {
    const std::uint32_t first = surface.vertexOfMesh[a], last = surface.vertexOfMesh[b];
    if (first != kNowhere && last != kNowhere) {
      const std::uint32_t edge = surface.edgeBetween(first, last);
      if (edge != kNowhere) return edge;
    }
  }
  // Fans beyond the first one at a place come after it and name the same mesh vertex.
  for (std::uint32_t e = 0; e < surface.edgeCount(); ++e) {
    const UVec2 v = surface.ends(e);
    const std::uint32_t p = surface.meshVertex[v.x], q = surface.meshVertex[v.y];
    if ((p == a && q == b) || (p == b && q == a)) return e;
  }
  throw ValueError("the mesh has no edge between vertices " + std::to_string(a) + " and " + std::to_string(b),
                   "charts.seams", "the mesh is not the one that was cut; draw the cut anew");
}

}  // namespace

std::size_t Seams::count() const {
  return std::size_t(std::count(marks_.begin(), marks_.end(), 1));
}

std::vector<std::uint32_t> Seams::edges() const {
  std::vector<std::uint32_t> list;
  for (std::uint32_t e = 0; e < marks_.size(); ++e)
    if (marks_[e]) list.push_back(e);
  return list;
}

void cutPath(const Surface& surface, std::span<const std::uint32_t> vertices, Seams& seams, bool cut) {
  for (std::size_t i = 1; i < vertices.size(); ++i) {
    const std::uint32_t edge = surface.edgeBetween(vertices[i - 1], vertices[i]);
    if (edge == kNowhere)
      throw ValueError("vertices " + std::to_string(vertices[i - 1]) + " and " + std::to_string(vertices[i]) +
                           " are not neighbours",
                       "cut", "give every vertex of the way");
    seams.set(edge, cut);
  }
}

std::vector<std::uint32_t> seamChain(const Surface& surface, const Seams& seams, std::uint32_t edge) {
  if (!seams[edge]) return {};
  std::vector<std::uint32_t> chain{edge};
  follow(surface, seams, edge, surface.ends(edge).x, chain);
  std::reverse(chain.begin(), chain.end());
  const std::size_t before = chain.size();
  follow(surface, seams, edge, surface.ends(edge).y, chain);
  std::vector<std::uint32_t> sorted = chain;
  std::sort(sorted.begin(), sorted.end());
  const bool loop = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();  // walked both ways
  if (loop) chain.resize(before);
  return chain;
}

double seamLength(const Surface& surface, const Seams& seams) {
  double sum = 0;
  for (std::uint32_t e = 0; e < seams.size(); ++e)
    if (seams[e] && !surface.isBorder(e)) sum += surface.length(e);
  return sum;
}

std::string seamsToText(const Surface& surface, const Seams& seams) {
  std::string text;
  Seams left = seams;
  // Chains from ends and forks first, then the loops that are left.
  for (const bool loops : {false, true})
    for (std::uint32_t e = 0; e < left.size(); ++e) {
      if (!left[e]) continue;
      const UVec2 v = surface.ends(e);
      std::uint32_t at = v.x;
      if (!loops && seamSpokes(surface, seams, v.x).size() == 2) {
        if (seamSpokes(surface, seams, v.y).size() == 2) continue;
        at = v.y;
      }
      std::vector<std::uint32_t> chain{e};
      const std::uint32_t next = surface.across(e, at);
      follow(surface, seams, e, next, chain);
      if (!text.empty()) text += ';';
      text += std::to_string(surface.meshVertex[at]);
      for (std::uint32_t edge : chain) {
        at = surface.across(edge, at);
        text += ' ' + std::to_string(surface.meshVertex[at]);
        left.set(edge, false);
      }
    }
  return text;
}

Seams seamsFromText(const Surface& surface, const std::string& text) {
  Seams seams(surface);
  std::uint32_t last = kNowhere;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == ';') last = kNowhere;
    if (text[at] == ';' || text[at] == ' ') {
      ++at;
      continue;
    }
    const std::uint32_t vertex = readNumber(text, at);
    if (last != kNowhere) seams.set(edgeOfMesh(surface, last, vertex));
    last = vertex;
  }
  return seams;
}

SurfacePaths::SurfacePaths(const Surface& surface, std::span<const float> costs)
    : surface_(surface), costs_(costs) {
  if (costs.size() != surface.edgeCount())
    throw ValueError("one cost per edge is wanted", "shortest paths", "use seamCosts() of the same surface");
}

void SurfacePaths::startFrom(std::span<const std::uint32_t> sources) {
  cost_.assign(surface_.vertexCount(), std::numeric_limits<double>::infinity());
  edgeTo_.assign(surface_.vertexCount(), kNowhere);
  settled_.assign(surface_.vertexCount(), 0);
  heap_.clear();
  for (std::uint32_t source : sources) {
    cost_[source] = 0;
    heap_.push_back({0, source});
  }
  std::make_heap(heap_.begin(), heap_.end());
}

std::uint32_t SurfacePaths::settleNext() {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end());
    const std::uint32_t vertex = heap_.back().vertex;
    heap_.pop_back();
    if (settled_[vertex]) continue;
    settled_[vertex] = 1;
    for (std::uint32_t i = surface_.spokeStart[vertex]; i < surface_.spokeStart[vertex + 1]; ++i) {
      const std::uint32_t edge = surface_.spokes[i], other = surface_.across(edge, vertex);
      const double cost = cost_[vertex] + costs_[edge];
      if (cost < cost_[other]) {
        cost_[other] = cost;
        edgeTo_[other] = edge;
        heap_.push_back({cost, other});
        std::push_heap(heap_.begin(), heap_.end());
      }
    }
    return vertex;
  }
  return kNowhere;
}

bool SurfacePaths::reach(std::uint32_t target, Job& job) {
  CancelCheck check(job);
  while (!settled_[target]) {
    check();
    if (settleNext() == kNowhere) return false;
  }
  return true;
}

void SurfacePaths::reachAll(Job& job) {
  CancelCheck check(job);
  while (settleNext() != kNowhere) check();
}

std::vector<std::uint32_t> SurfacePaths::pathTo(std::uint32_t target, Job& job) {
  if (!reach(target, job)) return {};
  std::vector<std::uint32_t> path{target};
  while (edgeTo_[path.back()] != kNowhere) path.push_back(surface_.across(edgeTo_[path.back()], path.back()));
  std::reverse(path.begin(), path.end());
  return path;
}

double SurfacePaths::distance(std::uint32_t vertex) const {
  return settled_[vertex] ? cost_[vertex] : std::numeric_limits<double>::infinity();
}

}  // namespace prt
