#include "libprt/synthesis/candidate_search.h"

namespace prt {

ShownExemplars exemplarsShown(const PatchExemplars& exemplars, std::uint32_t vertex) {
  constexpr float kNothing = 1.0f / 256;
  ShownExemplars out;
  if (exemplars.weights.empty()) {
    out.exemplar[0] = &exemplars.exemplars[0], out.weight[0] = 1, out.count = 1;
    return out;
  }
  const std::size_t each = exemplars.exemplars.size();
  for (std::size_t k = 0; k < each; ++k)
    if (const float weight = exemplars.weights[vertex * each + k]; weight > kNothing)
      out.exemplar[out.count] = &exemplars.exemplars[k], out.weight[out.count++] = weight;
  return out;
}

void CandidateSearch::look(std::uint32_t vertex, const Neighbourhoods& around, const std::vector<Vec2>& u) {
  count_ = 0;
  for (std::uint32_t slot = around.rings.start[vertex];
       slot < around.rings.start[vertex + 1] && count_ < kMost; ++slot) {
    const std::uint32_t q = around.rings.list[slot];
    Seen& s = seen_[count_++];
    s.offset = around.offset[slot];
    s.turn = around.turnOf(slot);
    // The way back to this vertex, in the neighbour's own frame.
    const int turns = exemplars_.turns();
    s.expected = u[q] - turnedBy(s.offset, s.turn == 0 ? 0 : turns - s.turn, turns);
    s.shown = torus_.texel(u[q]);
    s.source = torus_.texel(s.expected);
  }
}

/// Between what the patch shows at a texel and what a neighbour shows, by what this vertex sees of each
/// layer.
float CandidateSearch::difference(std::uint32_t texel, const Seen& s) const {
  float sum = 0;
  for (std::size_t k = 0; k < shown_.count; ++k) {
    const ExemplarLevel& level = shown_.exemplar[k]->levels[std::size_t(level_)];
    sum += shown_.weight[k] *
           appearanceDistance2(level.at(0, texel, texels2_), level.at(s.turn, s.shown, texels2_));
  }
  return sum;
}

float CandidateSearch::cost(const Vec2& u, float most) const {
  float sum = 0;
  for (std::size_t i = 0; i < count_ && sum < most; ++i) {
    const Seen& s = seen_[i];
    if (level_ >= 0) sum += difference(torus_.texel(u + s.offset), s);
    if (s.turn != 0) continue;
    const Vec2 d = torus_.shortest(s.expected - u);
    sum += kPrice * std::min(1.0f, dot(d, d) * inverseSpacing2_);
  }
  if (wish_ && wish_->strength > 0) {
    const float away = length(torus_.shortest(u - wish_->place * torus_.size)) / torus_.size;
    sum += wish_->strength * float(count_) * std::min(1.0f, std::max(0.0f, away - wish_->extent) * 8);
  }
  return sum;
}

/// What nearly goes on from several neighbours goes on from all of them in the mean.
void CandidateSearch::tryMean() {
  Vec2 sum(0);
  int used = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (seen_[i].turn != 0) continue;
    const Vec2 d = torus_.shortest(seen_[i].expected - best_);
    if (dot(d, d) * inverseSpacing2_ < 1) sum += d, ++used;
  }
  if (used > 0) attempt(best_ + sum / float(used));
}

void CandidateSearch::trySimilar() {
  for (std::size_t i = 0; i < count_; ++i) {
    const Seen& s = seen_[i];
    // A similar texel is entered at the same place inside it, where both are turned alike.
    const Vec2 inside = s.turn == 0 ? torus_.wrapped(s.expected) - torus_.centre(s.source) : Vec2(0);
    for (std::size_t n = 0; n < shown_.count; ++n) {
      const Exemplar& exemplar = *shown_.exemplar[n];
      const std::size_t k = std::size_t(exemplar.similar);
      const std::uint32_t* similar =
          &exemplar.levels[std::size_t(level_)].similar[(std::size_t(s.turn) * texels2_ + s.source) * k];
      for (std::size_t j = 0; j < k; ++j) attempt(torus_.centre(similar[j]) + inside);
    }
  }
}

Vec2 CandidateSearch::best(std::uint32_t vertex, const Neighbourhoods& around, const std::vector<Vec2>& u,
                           const VertexWish* wish) {
  wish_ = wish;
  if (level_ >= 0) shown_ = exemplarsShown(exemplars_, vertex);
  look(vertex, around, u);
  best_ = u[vertex];
  bestCost_ = cost(best_, 1e30f);
  for (std::size_t i = 0; i < count_; ++i)
    if (seen_[i].turn == 0) attempt(seen_[i].expected);
  tryMean();
  if (wish && wish->strength > 0) attempt(wish->place * torus_.size);
  if (level_ >= 0 && bestCost_ > kGoodEnough * float(count_)) {
    trySimilar();
    tryMean();
  }
  return best_;
}

}  // namespace prt
