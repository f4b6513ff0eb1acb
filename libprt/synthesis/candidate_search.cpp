#include "libprt/synthesis/candidate_search.h"

namespace prt {

void CandidateSearch::look(std::uint32_t vertex, const Neighbourhoods& around, const std::vector<Vec2>& u) {
  count_ = 0;
  for (std::uint32_t slot = around.rings.start[vertex];
       slot < around.rings.start[vertex + 1] && count_ < kMost; ++slot) {
    const std::uint32_t q = around.rings.list[slot];
    Seen& s = seen_[count_++];
    s.offset = around.offset[slot];
    s.turn = around.turnOf(slot);
    // The way back to this vertex, in the neighbour's own frame.
    s.expected = u[q] - turnedBy(s.offset, s.turn == 0 ? 0 : exemplar_.turns - s.turn, exemplar_.turns);
    s.appearance = level_ ? level_->at(s.turn, torus_.texel(u[q]), texels2_) : nullptr;
    s.source = torus_.texel(s.expected);
  }
}

float CandidateSearch::cost(const Vec2& u, float most) const {
  float sum = 0;
  for (std::size_t i = 0; i < count_ && sum < most; ++i) {
    const Seen& s = seen_[i];
    if (level_) sum += appearanceDistance2(level_->at(0, torus_.texel(u + s.offset), texels2_), s.appearance);
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
  const std::size_t k = std::size_t(exemplar_.similar);
  for (std::size_t i = 0; i < count_; ++i) {
    const Seen& s = seen_[i];
    const std::uint32_t* similar = &level_->similar[(std::size_t(s.turn) * texels2_ + s.source) * k];
    // A similar texel is entered at the same place inside it, where both are turned alike.
    const Vec2 inside = s.turn == 0 ? torus_.wrapped(s.expected) - torus_.centre(s.source) : Vec2(0);
    for (std::size_t j = 0; j < k; ++j) attempt(torus_.centre(similar[j]) + inside);
  }
}

Vec2 CandidateSearch::best(std::uint32_t vertex, const Neighbourhoods& around, const std::vector<Vec2>& u,
                           const VertexWish* wish) {
  wish_ = wish;
  look(vertex, around, u);
  best_ = u[vertex];
  bestCost_ = cost(best_, 1e30f);
  for (std::size_t i = 0; i < count_; ++i)
    if (seen_[i].turn == 0) attempt(seen_[i].expected);
  tryMean();
  if (wish && wish->strength > 0) attempt(wish->place * torus_.size);
  if (level_ && bestCost_ > kGoodEnough * float(count_)) {
    trySimilar();
    tryMean();
  }
  return best_;
}

}  // namespace prt
