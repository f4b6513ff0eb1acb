#pragma once
// One line on a terminal that shows how far a job is.

#include "libprt/core/job.h"

#include <string>

namespace prt::cli {

/// A listener for Job: draws over its own line on stderr, and clears it when a phase is done.
class ProgressBar {
 public:
  void operator()(const Progress& progress) const;
};

/// "direct transfer  [#########---------]  52 %  12.3 M rays/s  0:14 left", at most `width` columns.
std::string progressLine(const Progress& progress, int width);

/// 1234567 -> "1.23 M".
std::string shortNumber(double value);
/// 75 -> "1:15", 3700 -> "1:01:40".
std::string shortTime(double seconds);
/// 1234567 -> "1.18 MB" (1 MB = 2^20 bytes).
std::string byteCount(double bytes);

}  // namespace prt::cli
