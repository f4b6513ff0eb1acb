#pragma once
// Radiance transfer texture: the response of a small patch to light, B_i(u, v), for every texel of the patch
// and every view (Bi-Scale Radiance Transfer, section 4.2). Element i is the radiance that leaves texel u
// towards view v, the cosine and everything inside the patch included, for unit radiance in the i-th basis
// function of the patch's frame: exit radiance = sum of B_i L_i. A white Lambert plane under a constant sky
// of 1 gives 1.
//
// Texels are cell-centred on the plane midway in depth, tangent = +u; views are cell-centred on the
// Shirley-Chiu square of the upper hemisphere (basis/view_square.h).

#include "libprt/basis/sh.h"
#include "libprt/basis/view_square.h"
#include "libprt/core/array.h"
#include "libprt/core/image.h"

#include <span>
#include <vector>

namespace prt {

struct Rtt {
  int texels = 64;  ///< a side
  int views = 8;    ///< a side; 1 = one view, from above, for surfaces that look the same from everywhere
  int bands = 5;
  int channels = 1;  ///< 1: the same in all three but for `colour`, exactly
  Rgb colour{1};     ///< factor on everything
  int layers = 1;    ///< patches, one after the other in `values`: see rtt_layers.h; else only one is meant
  /// [v, u, view_y, view_x, k] or [v, u, view_y, view_x, k, 3]; v up, view_y up.
  std::vector<float> values;
  int bounces = 0;  ///< inside the patch
  int rays = 0;     ///< per point of the surface

  Rtt() = default;
  /// All zero. Throws ValueError when a size is out of range: texels 1..1024, views 1..32, bands 1..10.
  Rtt(int texels, int views, int bands, int channels);

  int functions() const { return shCount(bands); }
  int viewCount() const { return views * views; }
  /// Numbers of one texel and view: functions() * channels, channels fastest.
  std::size_t blockSize() const { return std::size_t(functions() * channels); }
  float* block(int u, int v, int view) { return values.data() + offset(u, v, view); }
  const float* block(int u, int v, int view) const { return values.data() + offset(u, v, view); }
  /// Texel that patch coordinates (any, they repeat) fall into.
  std::pair<int, int> texelAt(const Vec2& uv) const;

  /// Exit radiance under a light in the patch's frame, of one texel and view, or with the view interpolated
  /// between cell centres. Bands that one of the two lacks count as zero. May be slightly negative.
  Rgb exitRadiance(int u, int v, int view, const ShRgb& light) const;
  Rgb exitRadiance(int u, int v, const Vec3& view, const ShRgb& light) const;
  /// B of a texel towards any view, colour included: out[k], functions() of them.
  void response(int u, int v, const Vec3& view, std::span<Rgb> out) const;

  /// [texels, texels, views, views, k] or [..., k, 3] f32, the colour multiplied in.
  Array array() const;

 private:
  std::size_t offset(int u, int v, int view) const {
    return (std::size_t(v * texels + u) * std::size_t(viewCount()) + std::size_t(view)) * blockSize();
  }
};

/// The square patch as seen from one direction under a light in its frame, one pixel per texel times `zoom`,
/// v = 1 at the top: linear radiance, clamped at 0.
Image previewImage(const Rtt& rtt, const Vec3& view, const ShRgb& light, int zoom = 1);

/// Relative root-mean-square difference of two tables of the same sizes, colour included, over everything or
/// over one view: of `a` against `b`. Throws ValueError when the sizes differ.
double relativeDifference(const Rtt& a, const Rtt& b, int view = -1);

}  // namespace prt
