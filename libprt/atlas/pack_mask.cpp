#include "libprt/atlas/pack_mask.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace prt {

PackMask makeMask(std::span<const DVec2> polygon, double margin) {
  PackMask mask;
  DVec2 low = polygon[0], high = polygon[0];
  for (const DVec2& p : polygon) low = min(low, p), high = max(high, p);
  mask.origin = DVec2(margin) - low;
  const DVec2 extent = high - low + DVec2(2 * margin);
  mask.width = int(std::floor(extent.x)) + 1;
  mask.height = int(std::floor(extent.y)) + 1;
  std::vector<std::uint8_t> cells(std::size_t(mask.width) * std::size_t(mask.height), 0);
  std::vector<std::vector<double>> crossings{std::size_t(mask.height)};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVec2 a = polygon[i] + mask.origin, b = polygon[(i + 1) % polygon.size()] + mask.origin;
    // The outline with its margin, in pieces no longer than half a cell.
    const int pieces = std::max(1, int(std::ceil(2 * glm::distance(a, b))));
    for (int k = 0; k < pieces; ++k) {
      const DVec2 p = glm::mix(a, b, double(k) / pieces), q = glm::mix(a, b, double(k + 1) / pieces);
      const int x0 = std::max(0, int(std::floor(std::min(p.x, q.x) - margin)));
      const int x1 = std::min(mask.width - 1, int(std::floor(std::max(p.x, q.x) + margin)));
      const int y0 = std::max(0, int(std::floor(std::min(p.y, q.y) - margin)));
      const int y1 = std::min(mask.height - 1, int(std::floor(std::max(p.y, q.y) + margin)));
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) cells[std::size_t(y) * std::size_t(mask.width) + std::size_t(x)] = 1;
    }
    // Where it crosses the middle of rows, for the inside.
    const auto [lower, upper] = a.y < b.y ? std::pair(a, b) : std::pair(b, a);
    for (int y = std::max(0, int(std::ceil(lower.y - 0.5))); y < mask.height && y + 0.5 < upper.y; ++y)
      if (y + 0.5 >= lower.y)
        crossings[std::size_t(y)].push_back(lower.x +
                                            (y + 0.5 - lower.y) / (upper.y - lower.y) * (upper.x - lower.x));
  }
  mask.rows.resize(std::size_t(mask.height));
  for (int y = 0; y < mask.height; ++y) {
    std::vector<double>& cuts = crossings[std::size_t(y)];
    std::uint8_t* row = cells.data() + std::size_t(y) * std::size_t(mask.width);
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t i = 0; i + 1 < cuts.size(); i += 2)
      for (int x = std::max(0, int(std::ceil(cuts[i] - 0.5))); x < mask.width && x + 0.5 < cuts[i + 1]; ++x)
        row[x] = 1;
    for (int x = 0; x < mask.width;) {
      if (!row[x]) {
        ++x;
        continue;
      }
      const int begin = x;
      while (x < mask.width && row[x]) ++x;
      mask.rows[std::size_t(y)].push_back({begin, x});
    }
  }
  return mask;
}

PackGrid::PackGrid(int size)
    : size_(size), words_((size + 63) / 64), levels_(std::bit_width(unsigned(size))) {
  bits_.assign(std::size_t(levels_) * std::size_t(size_) * std::size_t(words_), 0);
}

void PackGrid::redo(int y) {
  for (int level = 1; level < levels_; ++level) {
    const std::uint64_t* from = row(level - 1, y);
    auto* to = const_cast<std::uint64_t*>(row(level, y));
    const int shift = 1 << (level - 1), words = shift / 64, bits = shift % 64;
    for (int w = 0; w < words_; ++w) {
      std::uint64_t moved = 0;
      if (w + words < words_) moved = from[w + words] >> bits;
      if (bits > 0 && w + words + 1 < words_) moved |= from[w + words + 1] << (64 - bits);
      to[w] = from[w] | moved;
    }
  }
}

void PackGrid::place(const PackMask& mask, int x, int y) {
  for (int r = 0; r < mask.height; ++r) {
    const int at = y + r;
    if (at < 0 || at >= size_) continue;
    auto* bits = const_cast<std::uint64_t*>(row(0, at));
    for (const PackMask::Run& run : mask.rows[std::size_t(r)])
      for (int c = std::max(0, x + run.begin); c < std::min(size_, x + run.end); ++c)
        bits[c / 64] |= std::uint64_t(1) << (c % 64);
    redo(at);
  }
}

bool PackGrid::find(const PackMask& mask, int limit, int& x, int& y) const {
  const int last = std::min(size_, limit) - mask.height, columns = size_ - mask.width + 1;
  if (last < 0 || columns <= 0) return false;
  std::vector<std::uint64_t> taken(std::size_t(words_) + 1);
  for (int at = 0; at <= last; ++at) {
    std::fill(taken.begin(), taken.end(), 0);
    bool full = false;
    for (int r = 0; r < mask.height && !full; ++r) {
      for (const PackMask::Run& run : mask.rows[std::size_t(r)]) {
        const int level = std::bit_width(unsigned(run.end - run.begin)) - 1;
        const std::uint64_t* bits = row(level, at + r);
        for (const int shift : {run.begin, run.end - (1 << level)}) {
          const int words = shift / 64, rest = shift % 64;
          const int count = words_ - words;
          if (rest == 0)
            for (int w = 0; w < count; ++w) taken[std::size_t(w)] |= bits[w + words];
          else {
            for (int w = 0; w + 1 < count; ++w)
              taken[std::size_t(w)] |= (bits[w + words] >> rest) | (bits[w + words + 1] << (64 - rest));
            if (count > 0) taken[std::size_t(count) - 1] |= bits[words_ - 1] >> rest;
          }
        }
      }
      if (r % 8 == 7) {
        full = true;
        for (int w = 0; w * 64 < columns && full; ++w) {
          const int left = columns - w * 64;
          const std::uint64_t want = left >= 64 ? ~std::uint64_t(0) : (std::uint64_t(1) << left) - 1;
          full = (taken[std::size_t(w)] & want) == want;
        }
      }
    }
    if (full) continue;
    for (int w = 0; w * 64 < columns; ++w) {
      const std::uint64_t free = ~taken[std::size_t(w)];
      if (free == 0) continue;
      const int column = w * 64 + std::countr_zero(free);
      if (column >= columns) break;
      x = column;
      y = at;
      return true;
    }
  }
  return false;
}

}  // namespace prt
