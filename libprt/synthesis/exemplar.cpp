#include "libprt/synthesis/exemplar.h"

#include "libprt/basis/sh_rotation.h"
#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/meso/rtt_compress.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

constexpr int kWindow = 2;            // texels to each side: 5 x 5
constexpr double kWindowSigma = 1.4;  // of the weights in it, in steps
constexpr double kBlur = 0.45;        // sigma of the blur before, in steps
constexpr int kBins = 8;              // a side: similar texels come from different bins

using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

int wrap(int x, int n) {
  return (x % n + n) % n;
}

/// Maps of coefficients, [texel, term], on the torus.
struct Maps {
  int texels = 0, terms = 0;
  std::vector<float> values;

  const float* at(int u, int v) const {
    return values.data() +
           (std::size_t(wrap(v, texels)) * std::size_t(texels) + std::size_t(wrap(u, texels))) *
               std::size_t(terms);
  }
};

/// Coefficients of the patch in all its turns, in one basis.
std::vector<Maps> coefficients(const Rtt& rtt, const ExemplarOptions& options, Job& job) {
  const std::size_t rows = std::size_t(rtt.texels) * std::size_t(rtt.texels);
  RttFactors factors;
  if (options.turns == 1) {
    factors = compressRtt(rtt, options.terms, job);
  } else {
    // All four quarter turns as one table: its rows are what counts, not where they lie.
    Rtt all;
    all.texels = 2 * rtt.texels, all.views = rtt.views, all.bands = rtt.bands, all.channels = rtt.channels;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const Rtt turned = turnedResponses(rtt, quarter);
      all.values.insert(all.values.end(), turned.values.begin(), turned.values.end());
    }
    factors = compressRtt(all, options.terms, job);
  }
  std::vector<Maps> maps;
  const std::size_t size = rows * std::size_t(factors.terms);
  for (int turn = 0; turn < options.turns; ++turn) {
    const float* first = factors.coefficients.data() + std::size_t(turn * (4 / options.turns)) * size;
    maps.push_back({rtt.texels, factors.terms, {first, first + size}});
  }
  return maps;
}

/// Gaussian blur on the torus, one axis after the other.
Maps blurred(const Maps& in, double sigma) {
  if (sigma < 0.2) return in;
  const int reach = std::min(in.texels / 2, int(std::ceil(3 * sigma)));
  std::vector<float> weight;
  float sum = 0;
  for (int i = -reach; i <= reach; ++i)
    sum += weight.emplace_back(float(std::exp(-0.5 * i * i / (sigma * sigma))));
  for (float& w : weight) w /= sum;
  Maps across = in, out = in;
  const auto pass = [&](const Maps& from, Maps& to, int du, int dv) {
    for (int v = 0; v < in.texels; ++v)
      for (int u = 0; u < in.texels; ++u) {
        float* o = to.values.data() +
                   (std::size_t(v) * std::size_t(in.texels) + std::size_t(u)) * std::size_t(in.terms);
        std::fill_n(o, in.terms, 0.0f);
        for (int i = -reach; i <= reach; ++i) {
          const float* f = from.at(u + i * du, v + i * dv);
          for (int t = 0; t < in.terms; ++t) o[t] += weight[std::size_t(i + reach)] * f[t];
        }
      }
  };
  pass(in, across, 1, 0);
  pass(across, out, 0, 1);
  return out;
}

/// out[t] = the maps at a place between texels, times a weight.
void sample(const Maps& maps, double u, double v, float weight, float* out) {
  const double fu = std::floor(u), fv = std::floor(v);
  const int iu = int(fu), iv = int(fv);
  const float a = float(u - fu), b = float(v - fv);
  const float *p = maps.at(iu, iv), *q = maps.at(iu + 1, iv), *r = maps.at(iu, iv + 1),
              *s = maps.at(iu + 1, iv + 1);
  for (int t = 0; t < maps.terms; ++t)
    out[t] = weight * ((1 - b) * ((1 - a) * p[t] + a * q[t]) + b * ((1 - a) * r[t] + a * s[t]));
}

/// Windows of all texels of all turns, one a row.
Rows windows(const std::vector<Maps>& maps, double spacing, Job& job) {
  const int n = maps[0].texels, terms = maps[0].terms, side = 2 * kWindow + 1;
  Rows rows(Eigen::Index(maps.size()) * n * n, Eigen::Index(side) * side * terms);
  for (std::size_t turn = 0; turn < maps.size(); ++turn) {
    job.checkCancelled();
    const Maps soft = blurred(maps[turn], spacing > 1.01 ? kBlur * spacing : 0);
    // Seen from a frame in which the patch is turned by the angle, a step lies turned back in the patch.
    const double angle = -2 * kPi * double(turn) / double(maps.size());
    const double cosine = std::round(std::cos(angle)), sine = std::round(std::sin(angle));
    parallelFor(job, 0, std::size_t(n * n), 512, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        float* out = rows.row(Eigen::Index(turn) * n * n + Eigen::Index(i)).data();
        for (int y = -kWindow; y <= kWindow; ++y)
          for (int x = -kWindow; x <= kWindow; ++x, out += terms) {
            const double weight = std::exp(-0.25 * (x * x + y * y) / (kWindowSigma * kWindowSigma));
            sample(soft, double(int(i) % n) + spacing * (cosine * x - sine * y),
                   double(int(i) / n) + spacing * (sine * x + cosine * y), float(weight), out);
          }
      }
    });
  }
  return rows;
}

/// Principal components of the windows, scaled so that random texels are at a mean squared distance of 1.
void reduce(Rows& rows, ExemplarLevel& level, std::size_t texels2, std::size_t turns) {
  const Eigen::RowVectorXf mean = rows.topRows(Eigen::Index(texels2)).colwise().mean();
  rows.rowwise() -= mean;
  const Eigen::MatrixXf covariance = rows.transpose() * rows / float(rows.rows());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXf> solver(covariance);  // ascending
  const Eigen::Index width = rows.cols(), kept = std::min<Eigen::Index>(width, kAppearance);
  double all = 0, held = 0;
  for (Eigen::Index i = 0; i < width; ++i) {
    const double value = std::max(0.0, double(solver.eigenvalues()[i]));
    all += value;
    if (i >= width - kept) held += value;
  }
  level.kept = all > 0 ? held / all : 1;
  level.appearance.assign(turns * texels2 * kAppearance, 0.0f);
  const Rows projected = rows * solver.eigenvectors().rightCols(kept);
  double variance = 0;  // of the patch as it is
  for (Eigen::Index c = 0; c < kept; ++c) {
    const auto column = projected.col(c).head(Eigen::Index(texels2)).cast<double>();
    variance += column.squaredNorm() / double(texels2) - std::pow(column.mean(), 2);
  }
  // What rounding leaves of a patch of one colour is not its appearance.
  const double size = double(mean.squaredNorm());
  if (!(variance > 1e-9 * size) || !(variance > 0)) return;
  const float scale = float(1 / std::sqrt(2 * variance));
  for (Eigen::Index r = 0; r < projected.rows(); ++r)
    for (Eigen::Index c = 0; c < kept; ++c)
      level.appearance[std::size_t(r) * kAppearance + std::size_t(c)] = scale * projected(r, kept - 1 - c);
}

float distance2(const float* a, const float* b) {
  float sum = 0;
  for (int i = 0; i < kAppearance; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

int torusDistance(int a, int b, int n) {
  const int d = std::abs(a - b);
  return std::min(d, n - d);
}

/// Similar texels of every texel in every turn: the best of every bin, then the best of these.
void findSimilar(const Exemplar& exemplar, ExemplarLevel& level, Job& job) {
  const int n = exemplar.texels, bins = std::min(kBins, n), apart = std::max(1, n / 20);
  const std::size_t texels2 = exemplar.count(), k = std::size_t(exemplar.similar);
  const int step = std::max(1, int(level.spacing / 2));
  level.similar.assign(std::size_t(exemplar.turns) * texels2 * k, 0);
  parallelFor(job, 0, std::size_t(exemplar.turns) * texels2, 64, [&](std::size_t begin, std::size_t end) {
    struct Best {
      float distance;
      std::uint32_t texel;
    };
    std::vector<Best> best(std::size_t(bins) * std::size_t(bins));
    for (std::size_t row = begin; row < end; ++row) {
      const int turn = int(row / texels2), own = int(row % texels2), ou = own % n, ov = own / n;
      const float* a = level.at(turn, std::uint32_t(own), texels2);
      std::fill(best.begin(), best.end(), Best{1e30f, std::uint32_t(own)});
      for (int v = 0; v < n; v += step)
        for (int u = 0; u < n; u += step) {
          if (turn == 0 && torusDistance(u, ou, n) <= apart && torusDistance(v, ov, n) <= apart) continue;
          const auto t = std::uint32_t(v * n + u);
          const float d = distance2(a, level.at(0, t, texels2));
          Best& b = best[std::size_t((v * bins / n) * bins + u * bins / n)];
          if (d < b.distance) b = {d, t};
        }
      std::stable_sort(best.begin(), best.end(),
                       [](const Best& x, const Best& y) { return x.distance < y.distance; });
      std::uint32_t* out = &level.similar[row * k];
      std::size_t found = 0;
      for (const Best& b : best) {
        if (found == k) break;
        bool near = b.distance > 1e29f;
        for (std::size_t i = 0; i < found && !near; ++i)
          near = torusDistance(int(out[i]) % n, int(b.texel) % n, n) <= apart &&
                 torusDistance(int(out[i]) / n, int(b.texel) / n, n) <= apart;
        if (!near) out[found++] = b.texel;
      }
      for (; found < k; ++found) out[found] = found > 0 ? out[found - 1] : std::uint32_t(own);
    }
  });
}

}  // namespace

Rtt turnedResponses(const Rtt& rtt, int quarters) {
  const double angle = quarters * kPi / 2;
  const ViewSquare square(rtt.views);
  // A view in the frame that stays is turned back in the patch's.
  std::vector<int> source(std::size_t(rtt.viewCount()));
  const Vec3 x(float(std::round(std::cos(angle))), float(std::round(std::sin(angle))), 0), y(-x.y, x.x, 0);
  for (int view = 0; view < rtt.viewCount(); ++view) {
    const Vec3 d = square.centre(view);
    source[std::size_t(view)] = rtt.views == 1 ? 0 : square.nearest({dot(d, x), dot(d, y), d.z});
  }
  Rtt out = rtt;
  std::vector<float> response(std::size_t(rtt.functions()));
  for (int texel = 0; texel < rtt.texels * rtt.texels; ++texel)
    for (int view = 0; view < rtt.viewCount(); ++view)
      for (int c = 0; c < rtt.channels; ++c) {
        const float* from = rtt.block(texel % rtt.texels, texel / rtt.texels, source[std::size_t(view)]);
        float* to = out.block(texel % rtt.texels, texel / rtt.texels, view);
        for (std::size_t k = 0; k < response.size(); ++k)
          response[k] = from[k * std::size_t(rtt.channels) + std::size_t(c)];
        rotateShAboutZ(rtt.bands, angle, std::span<float>(response));
        for (std::size_t k = 0; k < response.size(); ++k)
          to[k * std::size_t(rtt.channels) + std::size_t(c)] = response[k];
      }
  return out;
}

Exemplar makeExemplar(const Rtt& rtt, const ExemplarOptions& options, Job& job) {
  if (options.turns != 1 && options.turns != 2 && options.turns != 4)
    throw ValueError(std::to_string(options.turns) + " is no symmetry of a patch", "field.symmetry",
                     "use 1, 2 or 4");
  if (options.similar < 1 || options.similar > 8 || options.terms < 1 || options.terms > 64)
    throw ValueError("options of the exemplar are out of range", "exemplar",
                     "use 1 to 8 similar texels, 1 to 64 terms");
  Exemplar exemplar;
  exemplar.texels = rtt.texels, exemplar.turns = options.turns, exemplar.similar = options.similar;
  const std::vector<Maps> maps = coefficients(rtt, options, job);
  job.begin("exemplar", double(options.spacings.size()), "levels");
  for (const double spacing : options.spacings) {
    ExemplarLevel& level = exemplar.levels.emplace_back();
    level.spacing = std::max(1.0, spacing);
    Rows rows = windows(maps, level.spacing, job);
    job.checkCancelled();
    reduce(rows, level, exemplar.count(), std::size_t(options.turns));
    findSimilar(exemplar, level, job);
    job.advance(1);
  }
  return exemplar;
}

}  // namespace prt
