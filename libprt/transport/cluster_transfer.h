#pragma once
// Dense transfer matrices in few numbers a sample: clustered principal components (CPCA, Sloan, Hall, Hart
// and Snyder 2003, "Clustered principal components for precomputed radiance transfer"). Samples are gathered
// into clusters of alike matrices; in each, a matrix is the cluster's mean plus a weighted sum of a few
// others:
//   M_s = B_c0 + sum over t of w_st B_ct,  c the cluster of s.
// Light meets the B once per cluster; a sample then costs as many products of vectors as there are terms, and
// reads a hundredth of what its matrix takes. Errors are relative Frobenius norms over all samples.

#include "libprt/core/job.h"
#include "libprt/transport/transfer.h"

#include <optional>

namespace prt {

struct ClusterOptions {
  double budget = 0.01;  ///< error that may be added, > 0
  int clusters = 0;      ///< 0: one for about 150 samples, 1024 at most
  std::uint64_t seed = 1;
};

/// The same transfer with its matrices clustered, with the fewest terms (a multiple of 4, at most 32) that
/// keep the budget; storageError is what both roundings changed. Nothing where 32 terms do not keep it or
/// save no half of the memory, and for transfer that is not dense matrices. Same result for any number of
/// threads. Throws ValueError for a budget that is not positive, Cancelled.
std::optional<Transfer> clusteredTransfer(const Transfer& transfer, const ClusterOptions& options, Job& job);

/// Light met with the B of all clusters. Internal to transport.
struct LitClusters {
  std::size_t rows;           ///< of a cluster: terms + 1
  std::size_t stride;         ///< floats of a row: three times the functions, zeros up to a multiple of 8
  std::vector<float> values;  ///< [clusters, rows, stride]

  LitClusters(const Transfer& transfer, const std::vector<Rgb>& light);
};

}  // namespace prt
