#include "libprt/meso/btf_import.h"

#include "libprt/core/error.h"
#include "libprt/core/image_io.h"
#include "libprt/core/parallel.h"
#include "libprt/core/srgb.h"
#include "libprt/meso/light_projection.h"
#include "libprt/transport/memory_limit.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

constexpr std::size_t kManyLights = 20;  // per view: enough for a fit of its own
constexpr int kViewBands = 4;            // of smooth functions of the view

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A picture as texels, linear and scaled: [v * texels + u][3], v up.
class PictureReader {
 public:
  PictureReader(const BtfSet& set, int texels) : set_(set), texels_(texels) {}

  std::vector<float> read(std::size_t number) const {
    const std::filesystem::path file = set_.folder / set_.images[number].file;
    const Image image = readImage(file);
    const bool decoded = file.extension() != ".exr" && file.extension() != ".hdr";
    std::vector<float> out(std::size_t(texels_ * texels_) * 3);
    for (int v = 0; v < texels_; ++v)
      for (int u = 0; u < texels_; ++u) {
        const Rgb mean = texel(image, decoded, u, texels_ - 1 - v);
        if (!isFinite(mean))
          throw FileError("has a pixel that is not a finite number", file.string(), "repair the image");
        for (int c = 0; c < 3; ++c) out[std::size_t(3 * (v * texels_ + u) + c)] = mean[c];
      }
    return out;
  }

 private:
  Rgb texel(const Image& image, bool decoded, int column, int row) const {
    const int x0 = column * image.width / texels_,
              x1 = std::max(x0 + 1, (column + 1) * image.width / texels_);
    const int y0 = row * image.height / texels_, y1 = std::max(y0 + 1, (row + 1) * image.height / texels_);
    Rgb sum(0);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x)
        sum += linear(image.rgb(std::min(x, image.width - 1), std::min(y, image.height - 1)), decoded);
    return sum * float(set_.scale / ((x1 - x0) * (y1 - y0)));
  }
  /// What was read (PNG and JPEG decoded from sRGB) as the set says that it is encoded.
  Rgb linear(Rgb c, bool decoded) const {
    if (set_.gamma == 0 || (set_.gamma == 1 && !decoded)) return c;
    for (int i = 0; i < 3; ++i) {
      const float x = std::max(0.0f, c[i]), stored = decoded ? encodeSrgb(x) : x;
      c[i] = set_.gamma < 0 ? decodeSrgb(stored) : std::pow(stored, float(set_.gamma));
    }
    return c;
  }

  const BtfSet& set_;
  int texels_;
};

/// Every texel's B of one measured view added to the cells that it counts for.
void scatter(const std::vector<std::vector<float>>& pictures, std::span<const double> matrix,
             std::span<const double> weights, std::size_t measured, std::size_t view, Rtt& rtt, Job& job) {
  const std::size_t lights = pictures.size(), n = std::size_t(rtt.functions()),
                    cells = std::size_t(rtt.viewCount());
  parallelFor(job, 0, std::size_t(rtt.texels), 1, [&](std::size_t v, std::size_t) {
    std::vector<double> b(n * 3);
    for (int u = 0; u < rtt.texels; ++u) {
      std::fill(b.begin(), b.end(), 0.0);
      const std::size_t texel = v * std::size_t(rtt.texels) + std::size_t(u);
      for (std::size_t l = 0; l < lights; ++l)
        for (std::size_t k = 0; k < n; ++k)
          for (std::size_t c = 0; c < 3; ++c)
            b[3 * k + c] += matrix[k * lights + l] * double(pictures[l][3 * texel + c]);
      for (std::size_t cell = 0; cell < cells; ++cell) {
        const double weight = weights[cell * measured + view];
        float* to = rtt.block(u, int(v), int(cell));
        for (std::size_t i = 0; i < b.size(); ++i) to[i] += float(weight * b[i]);
      }
    }
  });
}

void importByView(const BtfSet& set, const std::vector<std::vector<std::size_t>>& groups, Rtt& rtt,
                  Job& job) {
  std::vector<Vec3> measured;
  for (const auto& group : groups) measured.push_back(set.images[group.front()].view);
  const std::vector<double> weights = viewWeights(measured, ViewSquare(rtt.views));
  const PictureReader reader(set, rtt.texels);
  for (std::size_t view = 0; view < groups.size(); ++view) {
    std::vector<Vec3> lights;
    std::vector<std::vector<float>> pictures;
    for (const std::size_t number : groups[view]) {
      job.checkCancelled();
      lights.push_back(set.images[number].light);
      pictures.push_back(reader.read(number));
      job.advance(1);
    }
    scatter(pictures, projectionMatrix(lightsAt(lights), rtt.bands, LightFit::Fit), weights, groups.size(),
            view, rtt, job);
  }
}

/// The matrix of the joint fit: [cells * functions, pictures].
Matrix jointMatrix(const BtfSet& set, const Rtt& rtt) {
  const Eigen::Index count = Eigen::Index(set.images.size()), n = rtt.functions(), m = shCount(kViewBands);
  std::vector<double> y(std::size_t(n), 0.0), z(std::size_t(m), 0.0);
  Matrix design(count, n * m);
  Eigen::VectorXd weight(count);
  for (Eigen::Index s = 0; s < count; ++s) {
    const BtfEntry& entry = set.images[std::size_t(s)];
    shEvaluate(rtt.bands, normalize(DVec3(entry.light)), y);
    shEvaluate(kViewBands, normalize(DVec3(entry.view)), z);
    const double cosine = std::max(0.02, double(entry.light.z));
    weight[s] = 1 / cosine;
    for (Eigen::Index j = 0; j < m; ++j)
      for (Eigen::Index k = 0; k < n; ++k)
        design(s, j * n + k) = cosine * y[std::size_t(k)] * z[std::size_t(j)];
  }
  Eigen::MatrixXd normal = design.transpose() * weight.asDiagonal() * design;
  const double scale = normal.trace() / double(n * m);
  const auto roughness = [](int l) { return double(l * l * (l + 1) * (l + 1)); };
  for (int lv = 0; lv < kViewBands; ++lv)
    for (int j = lv * lv; j < (lv + 1) * (lv + 1); ++j)
      for (int l = 0; l < rtt.bands; ++l)
        for (int k = l * l; k < (l + 1) * (l + 1); ++k)
          normal(j * n + k, j * n + k) += scale * (1e-6 + 1e-4 * roughness(l) + 1e-3 * roughness(lv));
  const Eigen::MatrixXd solved = normal.ldlt().solve((design.transpose() * weight.asDiagonal()).eval());
  const std::vector<double> gram = cosineGram(rtt.bands);
  const Eigen::Map<const Matrix> cosine(gram.data(), n, n);
  const ViewSquare square(rtt.views);
  Matrix out(square.count() * n, count);
  for (int cell = 0; cell < square.count(); ++cell) {
    shEvaluate(kViewBands, normalize(DVec3(square.centre(cell))), z);
    Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, count);
    for (Eigen::Index j = 0; j < m; ++j) c += z[std::size_t(j)] * solved.middleRows(j * n, n);
    out.middleRows(cell * n, n) = cosine * c;
  }
  return out;
}

void importJointly(const BtfSet& set, Rtt& rtt, Job& job) {
  const std::size_t count = set.images.size();
  requireMemory(count * std::size_t(rtt.texels * rtt.texels) * 12, "an imported BTF", "use fewer texels");
  const PictureReader reader(set, rtt.texels);
  std::vector<std::vector<float>> pictures;
  for (std::size_t i = 0; i < count; ++i) {
    job.checkCancelled();
    pictures.push_back(reader.read(i));
    job.advance(1);
  }
  const Matrix matrix = jointMatrix(set, rtt);
  parallelFor(job, 0, std::size_t(rtt.texels * rtt.texels), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t texel = begin; texel < end; ++texel) {
      Eigen::MatrixXd values(Eigen::Index(count), 3);
      for (std::size_t s = 0; s < count; ++s)
        for (int c = 0; c < 3; ++c)
          values(Eigen::Index(s), c) = double(pictures[s][3 * texel + std::size_t(c)]);
      const Eigen::MatrixXd b = matrix * values;
      float* to = rtt.block(int(texel) % rtt.texels, int(texel) / rtt.texels, 0);
      for (Eigen::Index i = 0; i < b.rows(); ++i)
        for (int c = 0; c < 3; ++c) to[3 * std::size_t(i) + std::size_t(c)] = float(b(i, c));
    }
  });
}

}  // namespace

std::vector<std::vector<std::size_t>> groupByView(const BtfSet& set) {
  constexpr float kSame = 0.1f * kPiF / 180;
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < set.images.size(); ++i) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      return length(set.images[group.front()].view - set.images[i].view) < kSame;
    });
    if (same == groups.end())
      groups.push_back({i});
    else
      same->push_back(i);
  }
  return groups;
}

std::vector<double> viewWeights(std::span<const Vec3> measured, const ViewSquare& cells) {
  const Eigen::Index n = Eigen::Index(measured.size()), count = cells.count();
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 1, n + 1);
  const auto distance = [](const Vec3& a, const Vec3& b) { return double(length(a - b)); };
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      system(i, j) = -distance(measured[std::size_t(i)], measured[std::size_t(j)]);
    system(i, n) = system(n, i) = 1;
  }
  Eigen::MatrixXd right(n + 1, count);
  for (Eigen::Index cell = 0; cell < count; ++cell) {
    for (Eigen::Index i = 0; i < n; ++i)
      right(i, cell) = -distance(measured[std::size_t(i)], cells.centre(int(cell)));
    right(n, cell) = 1;
  }
  const Eigen::MatrixXd solved = system.fullPivLu().solve(right);
  std::vector<double> weights(std::size_t(n * count));
  for (Eigen::Index cell = 0; cell < count; ++cell)
    for (Eigen::Index i = 0; i < n; ++i) weights[std::size_t(cell * n + i)] = solved(i, cell);
  return weights;
}

Rtt importBtf(const BtfSet& set, const BtfImportSettings& settings, Job& job) {
  if (set.images.empty()) throw FileError("lists no images", set.folder.string(), "name at least one");
  Rtt rtt(settings.texels, settings.views, settings.bands, 3);
  const auto groups = groupByView(set);
  job.begin("images of the BTF", double(set.images.size()), "images");
  const bool dense = std::ranges::all_of(groups, [](const auto& g) { return g.size() >= kManyLights; });
  if (dense)
    importByView(set, groups, rtt, job);
  else
    importJointly(set, rtt, job);
  return rtt;
}

}  // namespace prt
