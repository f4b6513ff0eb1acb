#include "libprt/transport/bounce_gather.h"

#include "libprt/basis/sh.h"
#include "libprt/basis/sh_rotation.h"
#include "libprt/core/parallel.h"

#include <algorithm>
#include <array>

namespace prt {
namespace {

using Float8 = float __attribute__((vector_size(32), aligned(4), may_alias));

inline Float8 load8(const float* p) {
  return *reinterpret_cast<const Float8*>(p);
}

/// One hit of a block: the rows that it interpolates and their weights; those of three vertices or four
/// texels.
template <std::size_t Around>
struct HitRows {
  std::array<const float*, Around> row;
  std::array<float, Around> weight;
};

/// Finds rows for hits, with or without the cosine in their weights.
class HitReader {
 public:
  HitReader(const Scene& scene, const SampleSet& surface, const SampleRows& leaving, bool cosine)
      : scene_(scene), surface_(surface), leaving_(leaving), cosine_(cosine) {}

  std::size_t around() const { return std::size_t(surface_.around()); }

  template <std::size_t Around>
  HitRows<Around> at(const HitBlock& block, std::size_t i) const {
    const std::uint32_t code = block.triangle[i], packed = block.barycentric[i], triangle = code & ~kBackHit;
    const float b1 = float(packed & 0xffffu) * (1.0f / 65535), b2 = float(packed >> 16) * (1.0f / 65535);
    const float scale = cosine_ ? block.cosine[i] : 1.0f;
    HitRows<Around> hit;
    const auto rowOf = [&](std::uint32_t front) {
      return leaving_.row(code & kBackHit ? surface_.back[front] : front);
    };
    if constexpr (Around == 3) {
      const UVec3& corner = scene_.mesh.triangles[triangle];
      hit.weight = {scale * (1 - b1 - b2), scale * b1, scale * b2};
      for (int k = 0; k < 3; ++k) hit.row[std::size_t(k)] = rowOf(corner[k]);
    } else {
      const TexelPlace place = surface_.texels->at(triangle, Vec2(b1, b2));
      for (std::size_t k = 0; k < Around; ++k)
        hit.weight[k] = scale * place.weight[k], hit.row[k] = rowOf(place.texel[k]);
    }
    return hit;
  }

 private:
  const Scene& scene_;
  const SampleSet& surface_;
  const SampleRows& leaving_;
  bool cosine_;
};

/// sum[0 .. 8 * Vectors) += weighted rows of the hits [begin, end), one after the other.
template <std::size_t Around, int Vectors>
void addHits(const HitReader& reader, const HitBlock& block, std::size_t begin, std::size_t end,
             std::size_t column, float* sum) {
  Float8 acc[Vectors];
  for (int v = 0; v < Vectors; ++v) acc[v] = load8(sum + column + std::size_t(8 * v));
  for (std::size_t i = begin; i < end; ++i) {
    const HitRows<Around> hit = reader.at<Around>(block, i);
    for (std::size_t k = 0; k < Around; ++k)
      for (int v = 0; v < Vectors; ++v)
        acc[v] += hit.weight[k] * load8(hit.row[k] + column + std::size_t(8 * v));
  }
  for (int v = 0; v < Vectors; ++v) *reinterpret_cast<Float8*>(sum + column + std::size_t(8 * v)) = acc[v];
}

template <std::size_t Around>
void addAllHits(const HitReader& reader, const HitBlock& block, std::size_t begin, std::size_t end,
                std::size_t stride, float* sum) {
  std::size_t column = 0;
  for (; column + 64 <= stride; column += 64) addHits<Around, 8>(reader, block, begin, end, column, sum);
  for (; column + 32 <= stride; column += 32) addHits<Around, 4>(reader, block, begin, end, column, sum);
  for (; column + 16 <= stride; column += 16) addHits<Around, 2>(reader, block, begin, end, column, sum);
  for (; column < stride; column += 8) addHits<Around, 1>(reader, block, begin, end, column, sum);
}

void addHits(const HitReader& reader, const HitBlock& block, std::size_t begin, std::size_t end,
             std::size_t stride, float* sum) {
  if (reader.around() == 3)
    addAllHits<3>(reader, block, begin, end, stride, sum);
  else
    addAllHits<4>(reader, block, begin, end, stride, sum);
}

/// The part of a sample's hits whose rays lie in [begin, end).
HitBlock::Range hitsOfRays(const HitBlock& block, std::size_t place, int begin, int end) {
  const auto first = block.ray.begin() + block.samples[place].begin,
             last = block.ray.begin() + block.samples[place].end;
  const auto at = [&](int ray) {
    return std::uint32_t(std::lower_bound(first, last, ray - block.beginRay) - block.ray.begin());
  };
  return {begin <= block.beginRay ? block.samples[place].begin : at(begin),
          end >= block.endRay ? block.samples[place].end : at(end)};
}

/// T += Y(direction of hit) x row(hit) over some hits of one sample, as a product of two small matrices.
class OuterProducts {
 public:
  OuterProducts(int bands, const SampleRows& leaving)
      : functions_(std::size_t(shCount(bands))),
        blocks_(sumStride(int(leaving.width)) / RayTable::kColumns),
        width_(leaving.width) {}

  /// Floats of one sample's T: functions rows of whole column blocks.
  std::size_t size() const { return functions_ * rowSize(); }
  std::size_t rowSize() const { return std::size_t(blocks_ * RayTable::kColumns); }

  void add(const RayTable& table, int scramble, const HitReader& reader, const HitBlock& block,
           HitBlock::Range range, float* sum) {
    const std::size_t count = range.end - range.begin;
    if (count == 0) return;
    rows_.assign(count * rowSize(), 0.0f);
    if (reader.around() == 3)
      readRows<3>(reader, block, range);
    else
      readRows<4>(reader, block, range);
    values_.resize(functions_ * count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto ray = std::size_t(block.ray[range.begin + i] + block.beginRay - table.begin());
      const float* y = table.functions(scramble);
      for (std::size_t k = 0; k < functions_; ++k)
        values_[k * count + i] =
            y[((k / kColumns) * std::size_t(table.size()) + ray) * kColumns + k % kColumns];
    }
    weights_.resize(functions_), to_.resize(functions_);
    for (std::size_t k = 0; k < functions_; ++k)
      weights_[k] = &values_[k * count], to_[k] = sum + k * rowSize();
    accumulateProducts(rows_.data(), int(count), blocks_, int(functions_), weights_.data(), to_.data());
  }

 private:
  template <std::size_t Around>
  void readRows(const HitReader& reader, const HitBlock& block, HitBlock::Range range) {
    const std::size_t count = range.end - range.begin;
    for (std::size_t i = 0; i < count; ++i) {
      const HitRows<Around> hit = reader.at<Around>(block, range.begin + i);
      for (std::size_t j = 0; j < width_; ++j) {
        float sum = 0;
        for (std::size_t k = 0; k < Around; ++k) sum += hit.weight[k] * hit.row[k][j];
        rows_[((j / kColumns) * count + i) * kColumns + j % kColumns] = sum;
      }
    }
  }

  static constexpr std::size_t kColumns = RayTable::kColumns;
  std::size_t functions_;
  int blocks_;
  std::size_t width_;
  std::vector<float> rows_, values_;
  std::vector<const float*> weights_;
  std::vector<float*> to_;
};

/// to[k * width + j] = scale * (D T)_kj: turns the rows from the sample's frame into the object's.
void rotateRows(const ShRotation& rotation, const float* local, std::size_t rowSize, std::size_t width,
                float scale, float* to) {
  for (int l = 0; l < rotation.bands(); ++l) {
    const double* d = rotation.block(l).data();
    for (int m = -l; m <= l; ++m, to += width) {
      std::fill(to, to + width, 0.0f);
      for (int k = -l; k <= l; ++k) {
        const float weight = scale * float(*d++);
        const float* from = local + std::size_t(shIndex(l, k)) * rowSize;
        for (std::size_t j = 0; j < width; ++j) to[j] += weight * from[j];
      }
    }
  }
}

}  // namespace

BounceGather::BounceGather(const Scene& scene, const RayScene& rays, const SampleSet& surface,
                           const SampleSet& samples, const DirectTransfer& direct, std::size_t hitMemory)
    : scene_(scene),
      rays_(rays),
      surface_(surface),
      samples_(samples),
      direct_(direct),
      spread_(direct.settings.visibility ? RaySpread::Uniform : RaySpread::Cosine),
      hitMemory_(hitMemory),
      hits_(direct.hits ? *direct.hits : HitBlocks(tileCount())) {
  hitBytes_ = hits_.bytes();
}

std::shared_ptr<const HitBlock> BounceGather::trace(const RayTable& table, std::size_t tile, Job& job) const {
  auto block = std::make_shared<HitBlock>(table.begin(), table.begin() + table.size(), tileSize(tile));
  SampleTracer tracer(scene_, rays_, samples_, spread_, direct_.settings.seed, table);
  std::vector<float> visible(std::size_t(table.size()));
  for (std::size_t i = 0; i < tileSize(tile); ++i) {
    job.checkCancelled();
    tracer.trace(tile * kBakeTile + i, visible, {}, block.get(), i);
  }
  block->shrink();
  return block;
}

void BounceGather::overChunk(int begin, int end, std::size_t firstTile, std::size_t lastTile, int bands,
                             Job& job, const TileBody& body) {
  std::unique_ptr<RayTable> table;
  bool remembered = true;
  for (std::size_t tile = firstTile; tile < lastTile; ++tile)
    remembered = remembered && hits_.covered(tile) >= end;
  if (bands > 0 || !remembered)
    table = std::make_unique<RayTable>(spread_, std::max(bands, 1), begin, end, direct_.settings.seed, job);
  parallelFor(job, firstTile, lastTile, 1, [&](std::size_t tile, std::size_t) {
    if (hits_.covered(tile) >= end) {
      body(tile, hits_.of(tile), table.get());
    } else {
      const std::array<std::shared_ptr<const HitBlock>, 1> fresh{trace(*table, tile, job)};
      body(tile, fresh, table.get());
      if (hits_.covered(tile) == begin && hitBytes_ < hitMemory_) {
        hitBytes_ += fresh[0]->bytes();
        hits_.add(tile, fresh[0]);
      }
    }
    job.advance(double(tileSize(tile)) * (end - begin));
  });
}

SampleRows BounceGather::irradiance(const SampleRows& leaving, Job& job) {
  SampleRows out(samples_.size(), leaving.width);
  const HitReader reader(scene_, surface_, leaving, spread_ == RaySpread::Uniform);
  const int rays = direct_.raysPerSample;
  for (int begin = 0; begin < rays; begin += kChunkRays) {
    const int end = std::min(rays, begin + kChunkRays);
    overChunk(begin, end, 0, tileCount(), 0, job, [&](std::size_t tile, auto blocks, const RayTable*) {
      for (std::size_t i = 0; i < tileSize(tile); ++i) {
        if (i % 8 == 0) job.checkCancelled();
        for (const auto& block : blocks) {
          if (block->endRay <= begin || block->beginRay >= end) continue;
          const HitBlock::Range range = hitsOfRays(*block, i, begin, end);
          addHits(reader, *block, range.begin, range.end, leaving.stride, out.row(tile * kBakeTile + i));
        }
      }
    });
  }
  const float scale = (spread_ == RaySpread::Cosine ? kPiF : 2 * kPiF) / float(rays);
  for (float& value : out.values) value *= scale;
  return out;
}

void BounceGather::directional(int bands, const SampleRows& leaving, Job& job, const UseMatrix& use) {
  constexpr std::size_t kSumMemory = std::size_t{64} << 20;
  const std::size_t sumSize = OuterProducts(bands, leaving).size();
  const std::size_t tilesAtOnce =
      std::max<std::size_t>(1, kSumMemory / (sumSize * sizeof(float) * kBakeTile));
  const HitReader reader(scene_, surface_, leaving, false);
  const int rays = direct_.raysPerSample;
  const std::uint64_t seed = direct_.settings.seed;
  std::vector<float> sums;
  for (std::size_t firstTile = 0; firstTile < tileCount(); firstTile += tilesAtOnce) {
    const std::size_t lastTile = std::min(tileCount(), firstTile + tilesAtOnce),
                      firstSample = firstTile * kBakeTile;
    sums.assign((lastTile - firstTile) * kBakeTile * sumSize, 0.0f);
    for (int begin = 0; begin < rays; begin += kChunkRays) {
      const int end = std::min(rays, begin + kChunkRays);
      overChunk(begin, end, firstTile, lastTile, bands, job,
                [&](std::size_t tile, auto blocks, const RayTable* table) {
                  OuterProducts products(bands, leaving);
                  for (std::size_t i = 0; i < tileSize(tile); ++i) {
                    job.checkCancelled();
                    const std::size_t sample = tile * kBakeTile + i;
                    for (const auto& block : blocks)
                      if (block->endRay > begin && block->beginRay < end)
                        products.add(*table, bakeScramble(samples_, sample, seed), reader, *block,
                                     hitsOfRays(*block, i, begin, end),
                                     &sums[(sample - firstSample) * sumSize]);
                  }
                });
    }
    const std::size_t lastSample = std::min(samples_.size(), lastTile * kBakeTile);
    parallelFor(job, firstSample, lastSample, kBakeTile, [&](std::size_t first, std::size_t last) {
      std::vector<float> matrix(std::size_t(shCount(bands)) * leaving.width);
      for (std::size_t s = first; s < last; ++s) {
        const ShRotation toObject(bands, bakeFrame(samples_, s, spread_, seed).matrix());
        rotateRows(toObject, &sums[(s - firstSample) * sumSize], OuterProducts(bands, leaving).rowSize(),
                   leaving.width, 2 * kPiF / float(rays), matrix.data());
        use(s, matrix.data());
      }
    });
  }
}

}  // namespace prt
