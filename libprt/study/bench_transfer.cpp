// Dense 25 x 25 transfer matrices, as they are stored, times an RGB light, against just reading the same
// memory with the same threads: applying light is bound by memory, and may take 1.3 times as long as reading
// it.

#include "libprt/core/parallel.h"
#include "libprt/core/sampling.h"
#include "libprt/study/bench_list.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/transfer.h"

#include <atomic>
#include <cstring>

namespace prt {
namespace {

constexpr std::size_t kVertices = 10800;
constexpr int kBands = 5;
constexpr double kLimit = 1.3;  // times the reading time

/// Matrices of the size and spread of real ones; what is in them does not change the time.
Transfer makeMatrices() {
  const std::size_t one = 625;
  std::vector<float> dense(kVertices * one);
  for (std::size_t i = 0; i < dense.size(); ++i) dense[i] = hashUniform(1, i) - 0.3f;
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

}  // namespace

BenchResult benchTransfer(Job& job, int repetitions) {
  const Transfer transfer = makeMatrices();
  ShRgb light(kBands);
  for (std::size_t k = 0; k < light.c.size(); ++k)
    light.c[k] = Rgb(hashUniform(2, k), hashUniform(3, k), hashUniform(4, k));
  std::vector<Rgb> out(kVertices * std::size_t(transfer.functions()));
  std::vector<double> ours, reading, ratios;
  std::uint64_t kept = 0;
  job.begin("bench transfer", repetitions, "repetitions");
  for (int i = -20; i < repetitions; ++i) {
    job.checkCancelled();
    const double read = secondsOf([&] { kept += readAll(transfer.values.bytes); });
    const double apply = secondsOf([&] { transferredRadiance(transfer, light, out); });
    if (i < 0) continue;  // warms caches and threads
    ours.push_back(apply), reading.push_back(read), ratios.push_back(read / apply);
    job.advance(1);
  }
  BenchResult result;
  result.ratio = median(ratios) * kLimit;
  result.ours = {median(ours) * 1e3, "ms"};
  result.againstWhat = "1.3 times just reading the stored matrices";
  result.against = {median(reading) * kLimit * 1e3, "ms"};
  result.details = {{"vertices", double(kVertices)},
                    {"megabytes", double(transfer.values.bytes.size()) * 1e-6},
                    {"read_ms", median(reading) * 1e3},
                    {"read_sum_parity", double(kept & 1)}};
  return result;
}

}  // namespace prt
