#pragma once
// GLSL made for a number of bands: straight-line code, because drivers do not reliably unroll loops, and
// arrays that are not unrolled live in memory.

#include <string>

namespace prt::gl {

/// Text to stand in front of a shader:
///   BANDS, kFunctions                        the number of bands and functions
///   FOR_EACH_FUNCTION(F)                     F(0, 0) F(1, 1) ... : index and band of every function
///   FOR_EACH_BAND_PAIR(F)                    F(0) F(1) ... : the number of each pair of bands
///   FOR_EACH_LIGHT_SLOT(F)                   F(0) F(1) ... : groups of four of 3 * kFunctions numbers
///   void shEvaluate(vec3 d, out float y[kFunctions])   real spherical harmonics as libprt/basis/sh.h
///   const float kCosine[BANDS]               band factors of the clamped cosine, over pi
std::string shGlsl(int bands);

}  // namespace prt::gl
