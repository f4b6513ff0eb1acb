#include "libprt/meso/patch_picture.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/meso/patch_lobe.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace prt {
namespace {

constexpr float kHalfFov = 0.26f;                         // radians
const Vec3 kSun = normalize(Vec3(-0.55f, 0.35f, 0.75f));  // in the patch's frame: turning shows the relief
constexpr float kSunRadiance = 1.8f, kSkyRadiance = 0.4f;
const Rgb kCut(0.035f);

void check(const PatchView& v, int width, int height) {
  const auto within = [](float x, float low, float high) { return x >= low && x <= high; };
  if (width < 1 || height < 1 || width > 8192 || height > 8192)
    throw ValueError(
        "a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels cannot be made",
        "patch picture", "use 1 to 8192 a side");
  if (v.periods < 1 || v.periods > 3 || v.samples < 1 || v.samples > 8 || !within(v.zoom, 0.1f, 10) ||
      !within(v.elevation, -1.5708f, 1.5708f) || !std::isfinite(v.azimuth))
    throw ValueError("the view is out of range", "patch picture",
                     "use 1 to 3 periods, 1 to 8 samples, zoom 0.1 to 10, elevation -pi/2 to pi/2");
}

/// The block that is shown, and the camera in front of it.
class Block {
 public:
  Block(const Patch& patch, const PatchView& view, int width, int height) : width_(width), height_(height) {
    const auto side = float(view.periods);
    low_ = Vec3(0, 0, patch.low - 1e-3f);
    high_ = Vec3(side, side, patch.high + 1e-3f);
    const float c = std::cos(view.elevation), s = std::sin(view.elevation);
    toEye_ = Vec3(c * std::sin(view.azimuth), -c * std::cos(view.azimuth), s);
    right_ = Vec3(std::cos(view.azimuth), std::sin(view.azimuth), 0);
    up_ = cross(toEye_, right_);
    const float radius = 0.5f * length(high_ - low_);
    const float narrow = std::min(1.0f, float(width) / float(height));
    eye_ = 0.5f * (low_ + high_) + toEye_ * (0.88f * radius / (std::sin(kHalfFov) * narrow * view.zoom));
  }

  /// The part of a pixel's ray inside the block; tFar < tNear when it passes by.
  Ray ray(float x, float y) const {
    const float scale = 2 * std::tan(kHalfFov) / float(height_);
    const Vec3 direction = normalize(-toEye_ + right_ * ((x - 0.5f * float(width_)) * scale) +
                                     up_ * ((0.5f * float(height_) - y) * scale));
    float enter = 0, leave = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(direction[axis]) < 1e-9f) {
        if (eye_[axis] < low_[axis] || eye_[axis] > high_[axis]) return {eye_, 0, direction, -1};
        continue;
      }
      float a = (low_[axis] - eye_[axis]) / direction[axis], b = (high_[axis] - eye_[axis]) / direction[axis];
      if (a > b) std::swap(a, b);
      enter = std::max(enter, a), leave = std::min(leave, b);
    }
    if (!(leave > enter)) return {eye_, 0, direction, -1};
    return {eye_ + enter * direction, 0, direction, leave - enter};
  }

 private:
  int width_, height_;
  Vec3 low_, high_, toEye_, right_, up_, eye_;
};

/// Light of the sun where it shines, and of a sky that is the same all round.
class Painter {
 public:
  explicit Painter(const PatchScene& patch) : patch_(patch) {}

  /// RGBA of rays that cross the block.
  void paint(std::span<const Ray> rays, std::span<glm::vec4> out) {
    hits_.resize(rays.size());
    patch_.rays->intersectRays(rays, hits_);
    for (std::size_t i = 0; i < rays.size(); ++i) out[i] = colour(rays[i], hits_[i]);
  }

 private:
  glm::vec4 colour(const Ray& ray, const Hit& hit) const {
    if (ray.tFar < ray.tNear) return glm::vec4(0);
    if (hit.valid() && !hit.back) return {lit(hit, -ray.direction), 1};
    if (hit.valid() || insideSolid(ray.origin)) return {kCut, 1};
    return glm::vec4(0);
  }

  /// Whether the surface is above, seen from behind.
  bool insideSolid(const Vec3& p) const {
    const Hit above = patch_.rays->intersect({p, 0, Vec3(0, 0, 1)});
    return above.valid() && above.back;
  }

  Rgb lit(const Hit& hit, const Vec3& toEye) const {
    const Patch& patch = *patch_.patch;
    const Vec3 n = normalAt(patch, hit);
    const Rgb albedo = patch.albedoAt(hit.triangle, hit.barycentric);
    Rgb out = albedo * (kSkyRadiance * (0.6f + 0.4f * n.z));
    const float cosine = dot(n, kSun);
    if (cosine > 0 && !patch_.rays->occluded({originAt(patch, hit), 0, kSun}))
      out += (albedo / kPiF + (patch.glossy() ? evalLobe(patch, hit, kSun, toEye) : Rgb(0))) *
             (kSunRadiance * kPiF * 0.5f * cosine);
    return out;
  }

  const PatchScene& patch_;
  std::vector<Hit> hits_;
};

}  // namespace

Image patchPicture(const PatchScene& patch, const PatchView& view, int width, int height, Job& job) {
  check(view, width, height);
  const Block block(*patch.patch, view, width, height);
  Image image(width, height, 4);
  job.begin("picture of the patch", height, "rows");
  parallelFor(job, 0, std::size_t(height), 4, [&](std::size_t begin, std::size_t end) {
    Painter painter(patch);
    const int side = view.samples, all = side * side;
    std::vector<Ray> rays;
    std::vector<glm::vec4> colours(std::size_t(width * all));
    for (std::size_t y = begin; y < end; ++y) {
      rays.clear();
      for (int x = 0; x < width; ++x)
        for (int k = 0; k < all; ++k)
          rays.push_back(block.ray(float(x) + (float(k % side) + 0.5f) / float(side),
                                   float(y) + (float(k / side) + 0.5f) / float(side)));
      painter.paint(rays, colours);
      for (int x = 0; x < width; ++x) {
        glm::vec4 mean(0);
        for (int k = 0; k < all; ++k) mean += colours[std::size_t(x * all + k)] / float(all);
        for (int c = 0; c < 4; ++c) image.pixel(x, int(y))[c] = mean[c];
      }
    }
    job.advance(double(end - begin));
  });
  return image;
}

}  // namespace prt
