#include "libprt/transport/error_map.h"

#include "libprt/core/parallel.h"
#include "libprt/transport/error_probe.h"

#include <cmath>

namespace prt {
namespace {

constexpr int kNoiseSweeps = 2;  // smoothing: noise is a smooth function of the surface
constexpr int kDifferenceSweeps = 1;
constexpr std::size_t kGrain = 2048;

/// A set of lights as linear maps from stored vectors to numbers whose squares add up: RGB irradiance under
/// one light, or every coefficient by its standard deviation for the prior.
struct ErrorJudge {
  virtual ~ErrorJudge() = default;
  /// Numbers for the product's bands, and for truncation.
  virtual std::size_t width() const = 0;
  virtual std::size_t truncatedWidth() const = 0;
  virtual void respond(const float* vectors, double* out) const = 0;
  virtual void truncated(const float* vectors, const float* tail, double* out) const = 0;
};

class LightJudge : public ErrorJudge {
 public:
  LightJudge(const JudgedLight& light, int bands, int channels)
      : channels_(channels), functions_(std::size_t(shCount(bands))) {
    const auto at = [](const ShRgb& sh, std::size_t k) {
      return k < sh.c.size() ? DVec3(sh.c[k]) : DVec3(0);
    };
    for (std::size_t k = 0; k < std::size_t(shCount(std::max(kErrorBands, bands))); ++k) {
      if (k < functions_)
        shown_.push_back(at(light.shown, k)), missing_.push_back(at(light.whole, k) - at(light.shown, k));
      else
        beyond_.push_back(at(light.whole, k));
    }
  }
  std::size_t width() const override { return 3; }
  std::size_t truncatedWidth() const override { return 3; }
  void respond(const float* vectors, double* out) const override { apply(shown_, vectors, out); }
  void truncated(const float* vectors, const float* tail, double* out) const override {
    apply(missing_, vectors, out);
    for (std::size_t k = 0; k < beyond_.size(); ++k)
      for (int c = 0; c < 3; ++c) out[c] += double(tail[k]) * beyond_[k][c];
  }

 private:
  void apply(const std::vector<DVec3>& light, const float* vectors, double* out) const {
    DVec3 sum(0);
    if (channels_ == 1)
      for (std::size_t k = 0; k < functions_; ++k) sum += double(vectors[k]) * light[k];
    else
      for (std::size_t k = 0; k < functions_; ++k)
        sum += DVec3(vectors[3 * k], vectors[3 * k + 1], vectors[3 * k + 2]) * light[k];
    for (int c = 0; c < 3; ++c) out[c] = sum[c];
  }

  int channels_;
  std::size_t functions_;
  std::vector<DVec3> shown_, missing_, beyond_;
};

class PriorJudge : public ErrorJudge {
 public:
  PriorJudge(int bands, int channels) : channels_(channels) {
    for (int l = 0; l < std::max(kErrorBands, bands); ++l)
      for (int m = -l; m <= l; ++m) (l < bands ? deviation_ : beyond_).push_back(1.0 / (l + 1));
  }
  std::size_t width() const override { return deviation_.size() * std::size_t(channels_); }
  std::size_t truncatedWidth() const override { return beyond_.size(); }
  void respond(const float* vectors, double* out) const override {
    // Grey light, three channels: one stored channel stands for all.
    const double repeated = channels_ == 1 ? std::sqrt(3.0) : 1.0;
    for (std::size_t i = 0; i < width(); ++i)
      out[i] = repeated * deviation_[i / std::size_t(channels_)] * double(vectors[i]);
  }
  void truncated(const float*, const float* tail, double* out) const override {
    for (std::size_t k = 0; k < beyond_.size(); ++k) out[k] = std::sqrt(3.0) * beyond_[k] * double(tail[k]);
  }

 private:
  int channels_;
  std::vector<double> deviation_, beyond_;
};

double dotOf(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// Mean squares at the vertices, before and after smoothing, and over the surface.
class Judging {
 public:
  Judging(const ProbedVertices& vertices, const ProbedPoints* points, const ErrorJudge& judge)
      : v_(vertices),
        points_(points),
        judge_(judge),
        width_(judge.width()),
        stride_(vertices.width()),
        noise_(v_.count()),
        truncation_(v_.count()),
        between_(v_.count()),
        irradiance_(v_.count()) {
    for (auto& half : half_) half.resize(v_.count() * width_);
  }

  ErrorMap run() {
    Job patient;
    parallelFor(patient, 0, v_.count(), kGrain,
                [&](std::size_t begin, std::size_t end) { atVertices(begin, end); });
    sumOverVertices();
    if (points_) betweenVertices();
    v_.neighbours.smooth(noise_, v_.area, kNoiseSweeps);
    v_.neighbours.smooth(truncation_, v_.area, kDifferenceSweeps);
    return result();
  }

 private:
  /// Noise: how the pilots scatter. Truncation: two independent estimates of what is missing, multiplied.
  void atVertices(std::size_t begin, std::size_t end) {
    std::array<std::vector<double>, kPilots> pilot;
    for (auto& each : pilot) each.resize(width_);
    std::vector<double> product(width_);
    std::array<std::vector<double>, 2> cut;
    for (auto& each : cut) each.resize(judge_.truncatedWidth());
    std::vector<float> mean(stride_);
    const std::size_t tail = v_.tail[0].size() / v_.count();
    for (std::size_t s = begin; s < end; ++s) {
      judge_.respond(&v_.product[s * stride_], product.data());
      irradiance_[s] = dotOf(product, product);
      for (std::size_t k = 0; k < kPilots; ++k) judge_.respond(&v_.pilots[k][s * stride_], pilot[k].data());
      for (std::size_t i = 0; i < width_; ++i) {
        double sum = 0, squares = 0;
        for (const auto& each : pilot) sum += each[i], squares += each[i] * each[i];
        noise_[s] += std::max(0.0, squares - sum * sum / kPilots) / (kPilots - 1);
        for (std::size_t h = 0; h < 2; ++h)
          half_[h][s * width_ + i] = 0.5 * (pilot[2 * h][i] + pilot[2 * h + 1][i]);
      }
      for (std::size_t h = 0; h < 2; ++h) {
        const float *a = &v_.pilots[2 * h][s * stride_], *b = &v_.pilots[2 * h + 1][s * stride_];
        for (std::size_t i = 0; i < stride_; ++i) mean[i] = 0.5f * (a[i] + b[i]);
        judge_.truncated(mean.data(), v_.tail[h].data() + s * tail, cut[h].data());
      }
      truncation_[s] = dotOf(cut[0], cut[1]);
    }
  }

  /// How much of the pilots' mean square noise is left in the product: two bakes with as many rays differ by
  /// twice the noise of one.
  double noiseRatio() const {
    double scatter = 0, difference = 0;
    std::vector<double> product(width_), again(width_);
    for (std::size_t i = 0; i < v_.again.size(); ++i) {
      const std::size_t s = v_.again[i];
      judge_.respond(&v_.product[s * stride_], product.data());
      judge_.respond(&v_.againVectors[i * stride_], again.data());
      for (std::size_t k = 0; k < width_; ++k) again[k] -= product[k];
      difference += v_.area[s] * dotOf(again, again) / 2;
      scatter += v_.area[s] * noise_[s];
    }
    return scatter > 0 ? difference / scatter : 0;
  }

  void sumOverVertices() {
    const double ratio = noiseRatio();
    for (double& each : noise_) each *= ratio;
    for (std::size_t s = 0; s < v_.count(); ++s) {
      area_ += v_.area[s], mean_ += v_.area[s] * irradiance_[s];
      total_.x += v_.area[s] * noise_[s], total_.z += v_.area[s] * truncation_[s];
    }
  }

  /// A product of two independent differences for each point, brought to the corners of its face by area.
  void betweenVertices() {
    const TriMesh& mesh = v_.scene->mesh;
    std::vector<double> weight(v_.count(), 0), truth(width_);
    std::array<std::vector<double>, 2> difference{truth, truth};
    for (std::size_t p = 0; p < points_->triangle.size(); ++p) {
      const UVec3& t = mesh.triangles[points_->triangle[p]];
      if (points_->buried[p] || v_.buried[t.x] || v_.buried[t.y] || v_.buried[t.z]) continue;
      const Vec2 b = points_->barycentric[p];
      for (std::size_t h = 0; h < 2; ++h) {
        judge_.respond(&points_->truth[h][p * stride_], truth.data());
        const auto at = [&](std::uint32_t v, std::size_t i) { return half_[h][v * width_ + i]; };
        for (std::size_t i = 0; i < width_; ++i)
          difference[h][i] = (1 - b.x - b.y) * at(t.x, i) + b.x * at(t.y, i) + b.y * at(t.z, i) - truth[i];
      }
      const double product = dotOf(difference[0], difference[1]),
                   here = 0.5 * length(mesh.areaNormal(points_->triangle[p]));
      faces_ += here, total_.y += here * product;
      for (int k = 0; k < 3; ++k) between_[t[k]] += here * product, weight[t[k]] += here;
    }
    for (std::size_t s = 0; s < v_.count(); ++s)
      if (weight[s] > 0) between_[s] /= weight[s];
    v_.neighbours.smooth(between_, weight, kDifferenceSweeps);
  }

  ErrorMap result() const {
    ErrorMap map;
    map.vertices.assign(v_.count(), Vec3(0));
    if (!(mean_ > 0) || !(area_ > 0)) return map;
    map.meanIrradiance = std::sqrt(mean_ / area_);
    const auto relative = [&](double squared) {
      return std::sqrt(std::max(0.0, squared)) / map.meanIrradiance;
    };
    for (std::size_t s = 0; s < v_.count(); ++s)
      map.vertices[s] = v_.buried[s]
                            ? Vec3(-1)
                            : Vec3(relative(noise_[s]), relative(between_[s]), relative(truncation_[s]));
    map.rms = {relative(total_.x / area_), faces_ > 0 ? relative(total_.y / faces_) : 0,
               relative(total_.z / area_)};
    return map;
  }

  const ProbedVertices& v_;
  const ProbedPoints* points_;
  const ErrorJudge& judge_;
  std::size_t width_, stride_;
  std::array<std::vector<double>, 2> half_;  // [V, width] responses of two pilots each
  std::vector<double> noise_, truncation_, between_, irradiance_;
  double area_ = 0, faces_ = 0, mean_ = 0;
  DVec3 total_{0};
};

/// A probe of the form None: nothing is baked, nothing can be wrong.
ErrorMap nothing(std::size_t vertices) {
  ErrorMap map;
  map.vertices.assign(vertices, Vec3(0));
  return map;
}

}  // namespace

float ErrorMap::total(std::size_t vertex) const {
  const Vec3& v = vertices[vertex];
  return v.x < 0 ? -1.0f : length(v);
}

double ErrorMap::totalRms() const {
  return length(rms);
}

double ErrorMap::share(Component component) const {
  const double all = dot(rms, rms);
  return all > 0 ? rms[component] * rms[component] / all : 0;
}

ErrorMap ErrorProbe::under(const JudgedLight& light) const {
  if (!vertices_ || vertices_->bands == 0) return nothing(vertexCount());
  return Judging(*vertices_, points_.get(), LightJudge(light, vertices_->bands, vertices_->channels)).run();
}

ErrorMap ErrorProbe::underPrior() const {
  if (!vertices_ || vertices_->bands == 0) return nothing(vertexCount());
  return Judging(*vertices_, points_.get(), PriorJudge(vertices_->bands, vertices_->channels)).run();
}

}  // namespace prt
