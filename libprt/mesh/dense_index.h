#pragma once
// Numbers for keys of a few 32-bit words, in the order in which they first come.

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace prt {

/// A hash table with open addressing: key -> 0, 1, 2, ... Expected constant time per key.
template <std::size_t N>
class DenseIndex {
 public:
  using Key = std::array<std::uint32_t, N>;

  explicit DenseIndex(std::size_t expected) {
    keys_.reserve(expected);
    slots_.assign(std::bit_ceil(2 * expected + 16), kEmpty);
  }
  std::size_t size() const { return keys_.size(); }
  const Key& key(std::uint32_t number) const { return keys_[number]; }

  std::uint32_t insert(const Key& key) {
    if (2 * keys_.size() >= slots_.size()) grow();
    std::size_t slot = hash(key) & (slots_.size() - 1);
    while (slots_[slot] != kEmpty) {
      if (keys_[slots_[slot]] == key) return slots_[slot];
      slot = (slot + 1) & (slots_.size() - 1);
    }
    slots_[slot] = std::uint32_t(keys_.size());
    keys_.push_back(key);
    return slots_[slot];
  }

 private:
  static constexpr std::uint32_t kEmpty = 0xffffffffu;

  static std::uint64_t hash(const Key& key) {
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (std::uint32_t word : key) {
      h = (h ^ word) * 0xff51afd7ed558ccdu;
      h ^= h >> 32;
    }
    return h;
  }
  void grow() {
    std::vector<std::uint32_t> larger(2 * slots_.size(), kEmpty);
    for (std::uint32_t number = 0; number < keys_.size(); ++number) {
      std::size_t slot = hash(keys_[number]) & (larger.size() - 1);
      while (larger[slot] != kEmpty) slot = (slot + 1) & (larger.size() - 1);
      larger[slot] = number;
    }
    slots_ = std::move(larger);
  }

  std::vector<Key> keys_;
  std::vector<std::uint32_t> slots_;
};

/// The bits of a float, both zeros the same.
inline std::uint32_t keyBits(float value) {
  return std::bit_cast<std::uint32_t>(value + 0.0f);
}

}  // namespace prt
