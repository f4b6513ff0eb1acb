#pragma once
// Bitmaps for packing. Internal to it.

#include "libprt/atlas/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace prt {

/// Cells that an outline covers or comes near to, as runs per row.
struct PackMask {
  struct Run {
    int begin, end;  // columns
  };
  int width = 0, height = 0;
  DVec2 origin{0};                     ///< of the outline's coordinates in the mask's, in cells
  std::vector<std::vector<Run>> rows;  ///< [height]
  std::vector<std::uint16_t> order;    ///< rows, widest first: the first ones tell most places that are taken
};

/// Fills `order`, which a search for places is quicker with.
void prepareSearch(PackMask& mask);

/// All cells that lie within `margin` cells of the polygon (scaled to cells already).
PackMask makeMask(std::span<const DVec2> polygon, double margin);

/// A square of cells, taken or free, with what is needed to find all free places of a mask at once: each row
/// also dilated to the left by powers of two, so that a run of any length is tested with two shifts.
class PackGrid {
 public:
  explicit PackGrid(int size);

  int size() const { return size_; }
  void place(const PackMask& mask, int x, int y);
  /// The free place whose upper end is lowest, then leftmost, with y + height <= limit; false when none is.
  bool find(const PackMask& mask, int limit, int& x, int& y) const;
  /// How snugly a mask lies: its sides to cells that are taken or outside, in circumferences of its box.
  double contact(const PackMask& mask, int x, int y) const;

 private:
  const std::uint64_t* row(int level, int y) const {
    return bits_.data() + (std::size_t(level) * std::size_t(size_) + std::size_t(y)) * std::size_t(words_);
  }
  void redo(int y);
  int takenIn(int y, int begin, int end) const;
  template <int W>
  bool findIn(const PackMask& mask, int last, int columns, int& x, int& y) const;

  int size_, words_, levels_;
  std::vector<std::uint64_t> bits_;
};

/// A square of cells, taken or free, for tests of single places.
class PackBits {
 public:
  explicit PackBits(int size);

  void set(const PackMask& mask, int x, int y, bool taken);
  /// All of the mask must lie in the square.
  bool isFree(const PackMask& mask, int x, int y) const;

 private:
  std::size_t words_;
  std::vector<std::uint64_t> bits_;
};

}  // namespace prt
