#pragma once
// Smaller number formats of a radiance transfer texture, with the error that they cost.

#include "libprt/meso/rtt.h"

namespace prt {

/// Values rounded to a storage type, as the arrays that hold them.
struct StoredRtt {
  Array values;      ///< f32, f16 or u8, [v, u, view_y, view_x, k] or [..., 3]
  Array lowest;      ///< u8: [k * channels] what byte 0 stands for, f32; else empty
  Array step;        ///< u8: [k * channels] what one more stands for, f32; else empty
  double error = 0;  ///< relative Frobenius norm of what rounding changed
};

/// `type`: f32, f16, or u8 (per function and channel, linear between its least and its largest value). Throws
/// ValueError for others.
StoredRtt storeRtt(const Rtt& rtt, DType type);

/// The values of a table whose sizes are set, from their arrays. Throws FileError when they do not fit.
void restoreRtt(const StoredRtt& stored, Rtt& rtt);

}  // namespace prt
