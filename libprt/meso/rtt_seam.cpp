#include "libprt/meso/rtt_seam.h"

#include "libprt/core/math.h"
#include "libprt/core/parallel.h"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace prt {
namespace {

using Complex = std::complex<double>;

/// Square images of one size, with the transforms that they share.
class Torus {
 public:
  explicit Torus(int side) : side_(side), cosine_(std::size_t(side)) {
    for (int k = 0; k < side; ++k) cosine_[std::size_t(k)] = std::cos(2 * kPi * k / side);
  }

  /// The smooth part of an image: its steps across the borders are those of `image`, its mean is 0.
  std::vector<double> smoothPart(const std::vector<double>& image) {
    std::vector<Complex> steps = bordersOf(image);
    transform(steps, true);
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        const double laplacian = 2 * cosine_[std::size_t(x)] + 2 * cosine_[std::size_t(y)] - 4;
        steps[at(x, y)] = x == 0 && y == 0 ? 0.0 : steps[at(x, y)] / laplacian;
      }
    transform(steps, false);
    std::vector<double> smooth(steps.size());
    for (std::size_t i = 0; i < steps.size(); ++i) smooth[i] = steps[i].real();
    return smooth;
  }

 private:
  std::size_t at(int x, int y) const { return std::size_t(y) * std::size_t(side_) + std::size_t(x); }

  /// What the Laplacian on the torus sees of the image only because it wraps around.
  std::vector<Complex> bordersOf(const std::vector<double>& image) const {
    std::vector<Complex> steps(image.size(), 0.0);
    const int last = side_ - 1;
    for (int i = 0; i < side_; ++i) {
      const double across = image[at(last, i)] - image[at(0, i)];
      steps[at(0, i)] += across, steps[at(last, i)] -= across;
      const double along = image[at(i, last)] - image[at(i, 0)];
      steps[at(i, 0)] += along, steps[at(i, last)] -= along;
    }
    return steps;
  }

  void transform(std::vector<Complex>& values, bool forward) {
    std::vector<Complex> line(std::size_t(side_), 0.0), out(std::size_t(side_), 0.0);
    for (const bool rows : {true, false})
      for (int i = 0; i < side_; ++i) {
        for (int k = 0; k < side_; ++k) line[std::size_t(k)] = values[rows ? at(k, i) : at(i, k)];
        if (forward)
          fft_.fwd(out, line);
        else
          fft_.inv(out, line);
        for (int k = 0; k < side_; ++k) values[rows ? at(k, i) : at(i, k)] = out[std::size_t(k)];
      }
  }

  int side_;
  std::vector<double> cosine_;
  Eigen::FFT<double> fft_;
};

}  // namespace

double seamStep(const Rtt& rtt) {
  const int last = rtt.texels - 1;
  if (last < 1) return 1;
  const std::size_t numbers = std::size_t(rtt.viewCount()) * rtt.blockSize();
  double border = 0, inside = 0, all = 0;
  for (const float x : rtt.values) all += double(x) * x;
  for (int v = 0; v < rtt.texels; ++v)
    for (int u = 0; u < rtt.texels; ++u) {
      const float* here = rtt.block(u, v, 0);
      const float* right = rtt.block(u == last ? 0 : u + 1, v, 0);
      const float* above = rtt.block(u, v == last ? 0 : v + 1, 0);
      double stepU = 0, stepV = 0;
      for (std::size_t i = 0; i < numbers; ++i) {
        stepU += double(right[i] - here[i]) * double(right[i] - here[i]);
        stepV += double(above[i] - here[i]) * double(above[i] - here[i]);
      }
      (u == last ? border : inside) += stepU;
      (v == last ? border : inside) += stepV;
    }
  // Steps of rounding are none: as sums of squares, 2 * texels of the texels^2 values stand at the borders.
  const double none = 1e-10 * 2 * all / rtt.texels;
  if (border <= none) return 1;
  return std::sqrt(border * last / std::max(inside, none));
}

void makeSeamless(Rtt& rtt, Job& job) {
  if (rtt.texels < 2) return;
  const std::size_t images = std::size_t(rtt.viewCount()) * rtt.blockSize();
  const auto texels = std::size_t(rtt.texels) * std::size_t(rtt.texels);
  parallelFor(job, 0, images, rtt.blockSize(), [&](std::size_t begin, std::size_t end) {
    Torus torus(rtt.texels);
    std::vector<double> image(texels);
    for (std::size_t i = begin; i < end; ++i) {
      job.checkCancelled();
      for (std::size_t t = 0; t < texels; ++t) image[t] = rtt.values[t * images + i];
      const std::vector<double> smooth = torus.smoothPart(image);
      for (std::size_t t = 0; t < texels; ++t) rtt.values[t * images + i] = float(image[t] - smooth[t]);
    }
  });
}

}  // namespace prt
