#include "libprt/atlas/elimination_order.h"

#include "libprt/atlas/surface.h"
#include "libprt/mesh/cancel_check.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>

namespace prt {
namespace {

using Nodes = std::vector<std::uint32_t>;

class Dissection {
 public:
  Dissection(std::size_t nodes, std::span<const std::pair<std::uint32_t, std::uint32_t>> edges, Job& job,
             std::size_t most)
      : job_(job), check_(job), most_(most), start_(nodes + 1, 0), region_(nodes, 0), place_(nodes) {
    for (const auto& [a, b] : edges) ++start_[a + 1], ++start_[b + 1];
    for (std::size_t v = 0; v < nodes; ++v) start_[v + 1] += start_[v];
    neighbours_.resize(2 * edges.size());
    std::vector<std::uint32_t> fill(start_.begin(), start_.end() - 1);
    for (const auto& [a, b] : edges) neighbours_[fill[a]++] = b, neighbours_[fill[b]++] = a;
    order_.reserve(nodes);
  }

  Nodes run() {
    Nodes all(region_.size());
    for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    eliminate(std::move(all), 0);
    return std::move(order_);
  }

 private:
  /// Nodes of a region in breadth, by level; parts that do not hang together one behind the other.
  struct Levels {
    Nodes nodes;
    std::vector<std::size_t> begin;  // of each level, and the end
  };

  /// `nodes` are all that are marked with `region`.
  void eliminate(Nodes nodes, std::uint32_t region) {
    job_.checkCancelled();
    if (nodes.size() <= most_) return minimumDegree(nodes, region);
    Levels levels = search(nodes, nodes[0], region);
    levels = search(nodes, levels.nodes.back(), region);  // from a far end: more levels, narrower ones
    const std::size_t cut = narrowestLevel(levels);
    if (cut == 0) return minimumDegree(nodes, region);
    const auto at = [&](std::size_t level) {
      return levels.nodes.begin() + std::ptrdiff_t(levels.begin[level]);
    };
    Nodes before(levels.nodes.begin(), at(cut)), separator(at(cut), at(cut + 1)),
        after(at(cut + 1), levels.nodes.end());
    nodes = {};
    levels = {};
    const std::uint32_t first = ++regions_, second = ++regions_;
    for (const std::uint32_t v : before) region_[v] = first;
    for (const std::uint32_t v : after) region_[v] = second;
    for (const std::uint32_t v : separator) region_[v] = kNowhere;
    eliminate(std::move(before), first);
    eliminate(std::move(after), second);
    order_.insert(order_.end(), separator.begin(), separator.end());
  }

  Levels search(const Nodes& nodes, std::uint32_t from, std::uint32_t region) {
    Levels levels;
    levels.nodes.reserve(nodes.size());
    std::vector<std::uint8_t>& seen = seen_;
    seen.assign(region_.size(), 0);
    std::size_t next = 0;  // of `nodes`, where the next part may begin
    for (std::uint32_t root = from; root != kNowhere;) {
      levels.begin.push_back(levels.nodes.size());
      levels.nodes.push_back(root);
      seen[root] = 1;
      for (std::size_t i = levels.begin.back(), end = levels.nodes.size(); i < end;) {
        for (; i < end; ++i)
          for (std::uint32_t p = start_[levels.nodes[i]]; p < start_[levels.nodes[i] + 1]; ++p) {
            check_();
            const std::uint32_t v = neighbours_[p];
            if (region_[v] != region || seen[v]) continue;
            seen[v] = 1;
            levels.nodes.push_back(v);
          }
        end = levels.nodes.size();
        if (i < end) levels.begin.push_back(i);
      }
      while (next < nodes.size() && seen[nodes[next]]) ++next;
      root = next < nodes.size() ? nodes[next] : kNowhere;
    }
    levels.begin.push_back(levels.nodes.size());
    return levels;
  }

  /// Of those that leave two fifths on either side at least; 0 when there is none.
  static std::size_t narrowestLevel(const Levels& levels) {
    const std::size_t all = levels.nodes.size();
    std::size_t best = 0, least = all;
    for (std::size_t level = 1; level + 2 < levels.begin.size(); ++level) {
      const std::size_t before = levels.begin[level], upTo = levels.begin[level + 1];
      if (before < all * 2 / 5 || all - upTo < all * 2 / 5 || upTo - before >= least) continue;
      best = level;
      least = upTo - before;
    }
    return best;
  }

  void minimumDegree(const Nodes& nodes, std::uint32_t region) {
    if (nodes.empty()) return;
    for (std::uint32_t k = 0; k < nodes.size(); ++k) place_[nodes[k]] = k;
    const auto size = Eigen::Index(nodes.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (std::uint32_t k = 0; k < nodes.size(); ++k) {
      entries.emplace_back(int(k), int(k), 1.0);
      for (std::uint32_t p = start_[nodes[k]]; p < start_[nodes[k] + 1]; ++p)
        if (region_[neighbours_[p]] == region) entries.emplace_back(int(k), int(place_[neighbours_[p]]), 1.0);
    }
    Eigen::SparseMatrix<double> pattern(size, size);
    pattern.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(pattern, permutation);
    for (Eigen::Index k = 0; k < size; ++k) order_.push_back(nodes[std::size_t(permutation.indices()[k])]);
  }

  Job& job_;
  CancelCheck check_;
  std::size_t most_;
  std::vector<std::uint32_t> start_, neighbours_;  // of each node
  std::vector<std::uint32_t> region_;              // [nodes]
  std::uint32_t regions_ = 0;
  std::vector<std::uint32_t> place_;  // [nodes] in the region being ordered
  std::vector<std::uint8_t> seen_;
  Nodes order_;
};

}  // namespace

std::vector<std::uint32_t> eliminationOrder(std::size_t nodes,
                                            std::span<const std::pair<std::uint32_t, std::uint32_t>> edges,
                                            Job& job, std::size_t most) {
  return Dissection(nodes, edges, job, most).run();
}

}  // namespace prt
