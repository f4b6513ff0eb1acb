#pragma once
// The choice of patch coordinates at one vertex. Internal to synthesis/. All coordinates are in texels.

#include "libprt/synthesis/texture_synthesis.h"

#include <array>
#include <cmath>

namespace prt {

/// Arithmetic on the torus of n texels a side.
struct TexelTorus {
  int n;
  float size;
  explicit TexelTorus(int texels) : n(texels), size(float(texels)) {}

  float wrapped(float x) const {
    x -= size * std::floor(x / size);
    return x < size ? x : 0.0f;
  }
  Vec2 wrapped(const Vec2& u) const { return {wrapped(u.x), wrapped(u.y)}; }
  std::uint32_t texel(const Vec2& u) const {
    const Vec2 w = wrapped(u);
    return std::uint32_t(std::min(int(w.y), n - 1) * n + std::min(int(w.x), n - 1));
  }
  /// The shortest way, each part in -n/2 .. n/2.
  Vec2 shortest(const Vec2& d) const {
    return {d.x - size * std::round(d.x / size), d.y - size * std::round(d.y / size)};
  }
  Vec2 centre(std::uint32_t texel) const {
    return {float(int(texel) % n) + 0.5f, float(int(texel) / n) + 0.5f};
  }
};

inline Vec2 turnedBy(const Vec2& v, int turn, int symmetry) {
  switch (turn * 4 / symmetry) {
    case 1:
      return {-v.y, v.x};
    case 2:
      return -v;
    case 3:
      return {v.y, -v.x};
    default:
      return v;
  }
}

/// The exemplars that a vertex shows something of.
struct ShownExemplars {
  static constexpr std::size_t kMost = 4;
  std::array<const Exemplar*, kMost> exemplar{};
  std::array<float, kMost> weight{};
  std::size_t count = 0;
};
ShownExemplars exemplarsShown(const PatchExemplars& exemplars, std::uint32_t vertex);

inline float appearanceDistance2(const float* a, const float* b) {
  float sum = 0;
  for (int i = 0; i < kAppearance; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

class CandidateSearch {
 public:
  /// `level`: of the exemplars; negative where the mesh is too coarse to tell texels apart, then only going
  /// on counts.
  CandidateSearch(const PatchExemplars& exemplars, int level, double spacing)
      : exemplars_(exemplars),
        level_(level),
        torus_(exemplars.texels()),
        texels2_(exemplars.count()),
        inverseSpacing2_(float(1 / (spacing * spacing))) {}

  /// The best coordinates for a vertex. `u`: coordinates of all vertices.
  Vec2 best(std::uint32_t vertex, const Neighbourhoods& around, const std::vector<Vec2>& u,
            const VertexWish* wish);

 private:
  static constexpr std::size_t kMost = 16;      // neighbours that are looked at
  static constexpr float kPrice = 0.06f;        // of not going on, against a distance of 1
  static constexpr float kGoodEnough = 0.004f;  // mean squared distance: nothing better is looked for
  struct Seen {
    Vec2 offset, expected;  // where it lies; coordinates that would go on from it
    std::uint32_t shown;    // texel that it shows
    std::uint32_t source;   // texel there, in its own turn
    int turn;
  };
  void look(std::uint32_t vertex, const Neighbourhoods& around, const std::vector<Vec2>& u);
  float difference(std::uint32_t texel, const Seen& s) const;
  float cost(const Vec2& u, float most) const;
  void attempt(const Vec2& u) {
    const float c = cost(u, bestCost_);
    if (c < bestCost_) bestCost_ = c, best_ = torus_.wrapped(u);
  }
  void tryMean();
  void trySimilar();

  const PatchExemplars& exemplars_;
  int level_;
  ShownExemplars shown_;  // by the vertex
  TexelTorus torus_;
  std::size_t texels2_;
  float inverseSpacing2_;
  const VertexWish* wish_ = nullptr;
  std::array<Seen, kMost> seen_;
  std::size_t count_ = 0;
  Vec2 best_{0};
  float bestCost_ = 0;
};

}  // namespace prt
