#include "libprt/atlas/pack_compact.h"

#include <algorithm>

namespace prt {
namespace {

struct Piece {
  PackMask mask;
  double angle = 0;
  int x = 0, y = 0;
};

class Compaction {
 public:
  Compaction(const PackTask& task, int cells, Job& job) : task_(task), cells_(cells), job_(job) {}

  /// The charts at a scale, each at the free place nearest to where it was asked for; false when one has
  /// none.
  bool lay(const std::vector<ChartPlacement>& places, double grow) {
    grid_ = std::make_unique<PackBits>(cells_);
    pieces_.resize(task_.charts.size());
    for (std::uint32_t c : task_.free) {  // largest first
      job_.checkCancelled();
      Piece& piece = pieces_[c];
      piece.angle = places[c].angle;
      const double scale = places[c].scale * grow / task_.relative[c];
      piece.mask = makeMask(task_.turned(c, scale, piece.angle, cells_), task_.margin(cells_));
      const DVec2 at = places[c].offset * (grow * cells_) - piece.mask.origin;
      if (!settle(piece, int(std::lround(at.x)), int(std::lround(at.y)))) return false;
      grid_->set(piece.mask, piece.x, piece.y, true);
    }
    return true;
  }

  /// Down and to the left until nothing moves.
  void slide() {
    constexpr int kSweeps = 4;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      bool moved = false;
      std::vector<std::uint32_t> order = task_.free;
      std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return pieces_[a].x + pieces_[a].y < pieces_[b].x + pieces_[b].y;
      });
      for (std::uint32_t c : order) {
        job_.checkCancelled();
        Piece& piece = pieces_[c];
        grid_->set(piece.mask, piece.x, piece.y, false);
        while (move(piece, 0, -1) || move(piece, -1, 0)) moved = true;
        grid_->set(piece.mask, piece.x, piece.y, true);
      }
      if (!moved) return;
    }
  }

  /// How much larger all could be by the room at the far sides.
  double room() const {
    int width = 1, height = 1;
    for (std::uint32_t c : task_.free) {
      width = std::max(width, pieces_[c].x + pieces_[c].mask.width);
      height = std::max(height, pieces_[c].y + pieces_[c].mask.height);
    }
    return double(cells_) / std::max(width, height);
  }

  std::vector<ChartPlacement> places(const std::vector<ChartPlacement>& before, double grow) const {
    std::vector<ChartPlacement> after = before;
    for (std::uint32_t c : task_.free) {
      after[c].scale = before[c].scale * grow;
      after[c].offset = (pieces_[c].mask.origin + DVec2(pieces_[c].x, pieces_[c].y)) / double(cells_);
    }
    return after;
  }

 private:
  bool fits(const Piece& piece, int x, int y) const {
    return x >= 0 && y >= 0 && x + piece.mask.width <= cells_ && y + piece.mask.height <= cells_ &&
           grid_->isFree(piece.mask, x, y);
  }

  bool settle(Piece& piece, int x, int y) const {
    constexpr int kReach = 6;
    for (int ring = 0; ring <= kReach; ++ring)
      for (int dy = -ring; dy <= ring; ++dy)
        for (int dx = -ring; dx <= ring; ++dx) {
          if (std::max(std::abs(dx), std::abs(dy)) != ring || !fits(piece, x + dx, y + dy)) continue;
          piece.x = x + dx, piece.y = y + dy;
          return true;
        }
    return false;
  }

  bool move(Piece& piece, int dx, int dy) const {
    if (!fits(piece, piece.x + dx, piece.y + dy)) return false;
    piece.x += dx, piece.y += dy;
    return true;
  }

  const PackTask& task_;
  int cells_;
  Job& job_;
  std::unique_ptr<PackBits> grid_;
  std::vector<Piece> pieces_;
};

}  // namespace

std::vector<ChartPlacement> compactLayout(const PackTask& task, std::vector<ChartPlacement> places, int cells,
                                          Job& job) {
  constexpr int kRounds = 6;
  double share = 1;  // of the room that is taken at once
  double grow = 1;
  for (int round = 0; round < kRounds; ++round) {
    Compaction compaction(task, cells, job);
    if (!compaction.lay(places, grow)) {
      if (grow == 1) break;
      share *= 0.5;
      grow = 1 + (grow - 1) * 0.5;
      if (grow < 1.001) break;
      continue;
    }
    compaction.slide();
    places = compaction.places(places, grow);
    grow = 1 + (compaction.room() - 1) * share;
    if (grow < 1.001) break;
  }
  return places;
}

}  // namespace prt
