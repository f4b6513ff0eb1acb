#include "libprt/atlas/pack_mask.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

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
  // Cells from which on, to the right, a row's middle is inside no more or again.
  std::vector<std::uint8_t> turns(cells.size(), 0);
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
      if (y + 0.5 >= lower.y) {
        const double cut = lower.x + (y + 0.5 - lower.y) / (upper.y - lower.y) * (upper.x - lower.x);
        const int x = std::max(0, int(std::ceil(cut - 0.5)));
        if (x < mask.width) turns[std::size_t(y) * std::size_t(mask.width) + std::size_t(x)] ^= 1;
      }
  }
  mask.rows.resize(std::size_t(mask.height));
  for (int y = 0; y < mask.height; ++y) {
    std::uint8_t* row = cells.data() + std::size_t(y) * std::size_t(mask.width);
    const std::uint8_t* turn = turns.data() + std::size_t(y) * std::size_t(mask.width);
    std::uint8_t inside = 0;
    for (int x = 0; x < mask.width; ++x) {
      inside ^= turn[x];
      row[x] |= inside;
    }
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

void prepareSearch(PackMask& mask) {
  std::vector<std::pair<int, std::uint16_t>> widths;
  for (std::uint16_t r = 0; r < mask.height; ++r) {
    int width = 0;
    for (const PackMask::Run& run : mask.rows[r]) width -= run.end - run.begin;
    widths.emplace_back(width, r);
  }
  std::sort(widths.begin(), widths.end());
  mask.order.clear();
  for (const auto& [width, r] : widths) mask.order.push_back(r);
}

PackGrid::PackGrid(int size)
    : size_(size), words_(size > 256 ? 8 : (size + 63) / 64), levels_(std::bit_width(unsigned(size))) {
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

/// The words of a row moved to the left by `shift` cells, into the places where a mask's first column may be.
template <int W>
inline void orShifted(const std::uint64_t* bits, int shift, std::uint64_t (&taken)[W]) {
  const int words = shift / 64, rest = shift % 64;
  if (rest == 0) {
    for (int w = 0; w + words < W; ++w) taken[w] |= bits[w + words];
    return;
  }
  for (int w = 0; w + words + 1 < W; ++w)
    taken[w] |= (bits[w + words] >> rest) | (bits[w + words + 1] << (64 - rest));
  taken[W - 1 - words] |= bits[W - 1] >> rest;
}

template <int W>
bool PackGrid::findIn(const PackMask& mask, int last, int columns, int& x, int& y) const {
  std::uint64_t outside[W] = {};
  for (int w = 0; w < W; ++w) {
    const int left = columns - w * 64;
    outside[w] = left >= 64 ? 0 : left <= 0 ? ~std::uint64_t(0) : ~std::uint64_t(0) << left;
  }
  std::vector<std::uint16_t> plain;
  if (mask.order.empty()) {
    plain.resize(std::size_t(mask.height));
    std::iota(plain.begin(), plain.end(), std::uint16_t(0));
  }
  const std::vector<std::uint16_t>& order = mask.order.empty() ? plain : mask.order;
  for (int at = 0; at <= last; ++at) {
    std::uint64_t taken[W];
    std::copy(outside, outside + W, taken);
    bool full = false;
    int done = 0;
    for (std::uint16_t r : order) {
      for (const PackMask::Run& run : mask.rows[r]) {
        const int level = std::bit_width(unsigned(run.end - run.begin)) - 1;
        const std::uint64_t* bits = row(level, at + r);
        orShifted<W>(bits, run.begin, taken);
        orShifted<W>(bits, run.end - (1 << level), taken);
      }
      if (++done % 2 != 0) continue;
      std::uint64_t all = ~std::uint64_t(0);
      for (int w = 0; w < W; ++w) all &= taken[w];
      full = all == ~std::uint64_t(0);
      if (full) break;
    }
    if (full) continue;
    for (int w = 0; w < W; ++w)
      if (~taken[w] != 0) {
        x = w * 64 + std::countr_zero(~taken[w]);
        y = at;
        return true;
      }
  }
  return false;
}

bool PackGrid::find(const PackMask& mask, int limit, int& x, int& y) const {
  const int last = std::min(size_, limit) - mask.height, columns = size_ - mask.width + 1;
  if (last < 0 || columns <= 0) return false;
  switch (words_) {
    case 1:
      return findIn<1>(mask, last, columns, x, y);
    case 2:
      return findIn<2>(mask, last, columns, x, y);
    case 3:
      return findIn<3>(mask, last, columns, x, y);
    case 4:
      return findIn<4>(mask, last, columns, x, y);
    default:
      return findIn<8>(mask, last, columns, x, y);
  }
}

namespace {

/// Calls word(index, bits) for the words that a run of cells touches until one returns false.
template <class Word>
bool overWords(int begin, int end, const Word& word) {
  const int first = begin / 64, last = (end - 1) / 64;
  for (int w = first; w <= last; ++w) {
    std::uint64_t bits = ~std::uint64_t(0);
    if (w == first) bits &= ~std::uint64_t(0) << (begin % 64);
    if (w == last && end % 64 != 0) bits &= (std::uint64_t(1) << (end % 64)) - 1;
    if (!word(std::size_t(w), bits)) return false;
  }
  return true;
}

}  // namespace

int PackGrid::takenIn(int y, int begin, int end) const {
  begin = std::max(begin, 0), end = std::min(end, size_);
  if (begin >= end) return 0;
  if (y < 0 || y >= size_) return end - begin;
  const std::uint64_t* bits = row(0, y);
  int sum = 0;
  overWords(begin, end, [&](std::size_t w, std::uint64_t cells) {
    sum += std::popcount(bits[w] & cells);
    return true;
  });
  return sum;
}

double PackGrid::contact(const PackMask& mask, int x, int y) const {
  // Its own cells are free: what is taken one row up or down, or beside a run, touches it.
  int taken = 0;
  for (int r = 0; r < mask.height; ++r)
    for (const PackMask::Run& run : mask.rows[std::size_t(r)]) {
      const int begin = x + run.begin, end = x + run.end;
      taken += takenIn(y + r - 1, begin, end) + takenIn(y + r + 1, begin, end);
      taken += begin == 0 ? 1 : takenIn(y + r, begin - 1, begin);
      taken += end == size_ ? 1 : takenIn(y + r, end, end + 1);
    }
  return double(taken) / double(2 * (mask.width + mask.height));
}

PackBits::PackBits(int size) : words_(std::size_t(size + 63) / 64), bits_(words_ * std::size_t(size), 0) {}

void PackBits::set(const PackMask& mask, int x, int y, bool taken) {
  for (int r = 0; r < mask.height; ++r) {
    std::uint64_t* row = bits_.data() + std::size_t(y + r) * words_;
    for (const PackMask::Run& run : mask.rows[std::size_t(r)])
      overWords(x + run.begin, x + run.end, [&](std::size_t w, std::uint64_t bits) {
        row[w] = taken ? row[w] | bits : row[w] & ~bits;
        return true;
      });
  }
}

bool PackBits::isFree(const PackMask& mask, int x, int y) const {
  for (int r = 0; r < mask.height; ++r) {
    const std::uint64_t* row = bits_.data() + std::size_t(y + r) * words_;
    for (const PackMask::Run& run : mask.rows[std::size_t(r)])
      if (!overWords(x + run.begin, x + run.end,
                     [&](std::size_t w, std::uint64_t bits) { return (row[w] & bits) == 0; }))
        return false;
  }
  return true;
}

}  // namespace prt
