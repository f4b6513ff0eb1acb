// Dense 25 x 25 transfer matrices, as they are stored, times an RGB light, against just reading the same
// memory with the same threads: applying light is bound by memory, and may take 1.3 times as long as reading
// it. Between two frames everything else that is drawn passes through the caches, so what counts is matrices
// that come from memory: both sides find the caches full of something else. Large caches hold all 13.5 MB
// when nothing else happens; then reading is much faster, and the product bound by its arithmetic. That case
// is in the details.

#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/study/bench_list.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/transfer.h"

#include <atomic>
#include <cmath>
#include <span>
#include <vector>

namespace prt {
namespace {

constexpr std::size_t kVertices = 10800;
constexpr int kBands = 5;
constexpr double kLimit = 1.3;  // times the reading time
constexpr std::size_t kEvictBytes = std::size_t{256} << 20;

/// Numbers of the size and spread of real matrices; what they are does not change the time.
std::vector<float> makeNumbers() {
  std::vector<float> dense(kVertices * 625);
  for (std::size_t i = 0; i < dense.size(); ++i) dense[i] = hashUniform(1, i) - 0.3f;
  return dense;
}

Transfer makeMatrices(std::span<const float> dense) {
  Transfer transfer;
  transfer.form = TransferForm::Matrix;
  transfer.bands = kBands;
  transfer.samples = kVertices;
  transfer.values = packedMatrices(dense, kVertices, 1, kBands, DType::f16);
  return transfer;
}

/// Reads every byte with wide loads; the result keeps the compiler from dropping them.
std::uint64_t readAll(std::span<const std::byte> bytes) {
  using Words = std::uint64_t __attribute__((vector_size(32), aligned(1), may_alias));
  constexpr std::size_t kLine = 4 * sizeof(Words);
  std::atomic<std::uint64_t> total{0};
  Job job;
  parallelFor(job, 0, bytes.size() / kLine, 320000 / kLine, [&](std::size_t begin, std::size_t end) {
    Words sum[4] = {};
    for (std::size_t i = begin; i < end; ++i) {
      const auto* line = reinterpret_cast<const Words*>(bytes.data() + i * kLine);
      for (int k = 0; k < 4; ++k) sum[k] += line[k];
    }
    const Words all = sum[0] + sum[1] + sum[2] + sum[3];
    total += all[0] + all[1] + all[2] + all[3];
  });
  return total;
}

/// Fills the caches with something else, by all threads.
void evict(std::vector<std::uint64_t>& other) {
  Job job;
  parallelFor(job, 0, other.size(), other.size() / 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++other[i];
  });
}

/// Seconds of reading and of applying, alternating.
struct Times {
  std::vector<double> read, apply, ratios;
  void add(double r, double a) { read.push_back(r), apply.push_back(a), ratios.push_back(r / a); }
};

/// What rounding to the stored type changes, relative (Frobenius).
double storageError(const Transfer& transfer, std::span<const float> dense) {
  const Array back = expandedMatrices(transfer);
  double square = 0, difference = 0;
  for (std::size_t i = 0; i < dense.size(); ++i) {
    square += double(dense[i]) * dense[i];
    difference += std::pow(double(back.as<float>()[i]) - dense[i], 2);
  }
  return std::sqrt(difference / square);
}

}  // namespace

BenchResult benchTransfer(Job& job, int repetitions) {
  const std::vector<float> dense = makeNumbers();
  const Transfer transfer = makeMatrices(dense);
  ShRgb light(kBands);
  for (std::size_t k = 0; k < light.c.size(); ++k)
    light.c[k] = Rgb(hashUniform(2, k), hashUniform(3, k), hashUniform(4, k));
  std::vector<Rgb> out(kVertices * std::size_t(transfer.functions()));
  std::vector<std::uint64_t> other(kEvictBytes / sizeof(std::uint64_t), 0);
  std::uint64_t kept = 0;
  Times fromMemory, fromCache;
  const auto measure = [&](Times& times, bool evicted, int count) {
    const auto timed = [&](const auto& work) {
      if (evicted) evict(other);
      return secondsOf(work);
    };
    for (int i = -5; i < count; ++i) {
      job.checkCancelled();
      const double read = timed([&] { kept += readAll(transfer.values.bytes); });
      const double apply = timed([&] { transferredRadiance(transfer, light, out); });
      if (i < 0) continue;  // warms caches and threads
      times.add(read, apply);
      job.advance(1);
    }
  };
  job.begin("bench transfer", 5.0 * repetitions, "repetitions");
  measure(fromMemory, true, repetitions);
  measure(fromCache, false, 4 * repetitions);  // short, and cheap to repeat
  const double bytes = double(transfer.values.bytes.size());
  const auto rate = [&](const std::vector<double>& seconds) { return bytes / median(seconds) * 1e-9; };
  BenchResult result;
  result.ratio = median(fromMemory.ratios) * kLimit;
  result.ours = {median(fromMemory.apply) * 1e3, "ms"};
  result.againstWhat = "1.3 times just reading the stored matrices from memory";
  result.against = {median(fromMemory.read) * kLimit * 1e3, "ms"};
  result.details = {{"vertices", double(kVertices)},
                    {"megabytes", bytes * 1e-6},
                    {"storage_error", storageError(transfer, dense)},
                    {"read_ms", median(fromMemory.read) * 1e3},
                    {"read_gb_per_s", rate(fromMemory.read)},
                    {"apply_gb_per_s", rate(fromMemory.apply)},
                    {"cached_ratio", median(fromCache.ratios) * kLimit},
                    {"cached_read_ms", median(fromCache.read) * 1e3},
                    {"cached_apply_ms", median(fromCache.apply) * 1e3},
                    {"cached_read_gb_per_s", rate(fromCache.read)},
                    {"cached_apply_gb_per_s", rate(fromCache.apply)},
                    {"read_sum_parity", double(kept & 1)}};
  return result;
}

}  // namespace prt
