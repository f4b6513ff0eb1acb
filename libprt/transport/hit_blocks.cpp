#include "libprt/transport/hit_blocks.h"

#include <algorithm>

namespace prt {
namespace {

std::uint32_t packBarycentric(const Vec2& b) {
  const auto part = [](float x) { return std::uint32_t(std::clamp(x, 0.0f, 1.0f) * 65535.0f + 0.5f); };
  return part(b.x) | part(b.y) << 16;
}

}  // namespace

std::size_t HitBlocks::bytes() const {
  std::size_t sum = 0;
  for (const auto& tile : tiles_)
    for (const auto& block : tile) sum += block->bytes();
  return sum;
}

SampleTracer::SampleTracer(const Scene& scene, const RayScene& rays, const SampleSet& samples,
                           RaySpread spread, std::uint64_t seed, const RayTable& table)
    : scene_(scene),
      rays_(rays),
      samples_(samples),
      spread_(spread),
      seed_(seed),
      table_(table),
      blocked_(std::size_t(table.size())),
      cosine_(blocked_.size()),
      place_(blocked_.size()) {}

void SampleTracer::trace(std::size_t sample, std::span<float> visible, std::span<float> cosine,
                         HitBlock* block, std::size_t place) {
  const int scramble = bakeScramble(samples_, sample, seed_);
  directions_.turn(table_, scramble, bakeFrame(samples_, sample, spread_, seed_));
  findBlocked(samples_.origin[sample], block != nullptr);
  if (spread_ == RaySpread::Cosine) clipAtHorizon(samples_.geometricNormal[sample]);
  const Vec3 n = samples_.shadingNormal[sample];
  for (std::size_t i = 0; i < cosine_.size(); ++i)
    cosine_[i] = std::max(0.0f, directions_.x[i] * n.x + directions_.y[i] * n.y + directions_.z[i] * n.z);
  order_ = table_.order(scramble);
  for (std::size_t i = 0; i < blocked_.size(); ++i) visible[order_[i]] = blocked_[i] ? 0.0f : 1.0f;
  for (std::size_t i = 0; i < cosine.size(); ++i) cosine[order_[i]] = blocked_[i] ? 0.0f : cosine_[i];
  if (block) keepHits(*block, place);
}

void SampleTracer::findBlocked(const Vec3& origin, bool hits) {
  if (!hits) return rays_.occludedFrom(origin, directions_.x, directions_.y, directions_.z, blocked_);
  hits_.resize(blocked_.size());
  rays_.intersectFrom(origin, directions_.x, directions_.y, directions_.z, hits_);
  for (std::size_t i = 0; i < hits_.size(); ++i) blocked_[i] = hits_[i].valid();
}

/// Rays below the horizon would start inside of the surface: blocked, and by nothing that reflects.
void SampleTracer::clipAtHorizon(const Vec3& n) {
  for (std::size_t i = 0; i < blocked_.size(); ++i) {
    if (directions_.x[i] * n.x + directions_.y[i] * n.y + directions_.z[i] * n.z > 0) continue;
    blocked_[i] = 1;
    if (!hits_.empty()) hits_[i] = Hit{};
  }
}

void SampleTracer::keepHits(HitBlock& block, std::size_t place) {
  for (std::size_t i = 0; i < order_.size(); ++i) place_[order_[i]] = std::uint16_t(i);
  block.samples[place].begin = std::uint32_t(block.triangle.size());
  for (std::size_t r = 0; r < place_.size(); ++r) {
    const Hit& hit = hits_[place_[r]];
    if (!hit.valid() || (hit.back && !scene_.materialOf(hit.triangle).twoSided))
      continue;  // a back only blocks
    if (spread_ == RaySpread::Uniform) block.cosine.push_back(cosine_[place_[r]]);
    block.triangle.push_back(hit.triangle | (hit.back ? kBackHit : 0));
    block.barycentric.push_back(packBarycentric(hit.barycentric));
    block.ray.push_back(std::uint16_t(r));
  }
  block.samples[place].end = std::uint32_t(block.triangle.size());
}

}  // namespace prt
