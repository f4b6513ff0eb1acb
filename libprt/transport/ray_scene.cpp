#include "libprt/transport/ray_scene.h"

#include "libprt/core/error.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

namespace prt {
namespace {

constexpr float kLargest = 1e18f;  // Embree asserts a little above this
constexpr std::size_t kPacket = 16;

/// False for NaN too.
inline bool inRange(float x) {
  return std::abs(x) <= kLargest;
}
inline bool inRange(const Vec3& v) {
  return inRange(v.x) && inRange(v.y) && inRange(v.z);
}
inline bool usable(const Ray& ray) {
  return inRange(ray.origin) && inRange(ray.direction) && ray.direction != Vec3(0) && ray.tNear >= 0 &&
         std::isfinite(ray.tNear) && !std::isnan(ray.tFar);
}

/// One device for the process: Embree keeps process-wide state behind it.
RTCDevice device() {
  static const RTCDevice shared = rtcNewDevice(nullptr);
  if (!shared)
    throw ResourceError("ray tracing device cannot be created", "Embree", "check the installation");
  return shared;
}

template <class T, class From>
void fillBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<From>& from) {
  static_assert(sizeof(From) == sizeof(T) * 3);
  void* to = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(From), from.size());
  if (!to) throw ResourceError("no memory for the ray tracing scene", "Embree", "simplify the mesh");
  std::memcpy(to, from.data(), from.size() * sizeof(From));
}

void checkPositions(const Scene& scene) {
  for (const Vec3& p : scene.mesh.positions)
    if (!inRange(p))
      throw GeometryError("a vertex is not finite or beyond 1e18", "scene",
                          "repair the mesh, or use a smaller scale");
}

RTCRay embreeRay(const Ray& ray) {
  return {ray.origin.x,
          ray.origin.y,
          ray.origin.z,
          ray.tNear,
          ray.direction.x,
          ray.direction.y,
          ray.direction.z,
          0,
          ray.tFar,
          0xffffffffu,
          0,
          0};
}

/// Packets of 16 rays from one origin. Lanes that are switched off keep a harmless direction.
struct Packet {
  alignas(64) int valid[kPacket];

  /// Fills lanes from directions [first, first + count); returns how many were refused.
  int load(RTCRay16& rays, const Vec3& origin, const float* dx, const float* dy, const float* dz,
           std::size_t count) {
    int refused = 0;
    for (std::size_t k = 0; k < kPacket; ++k) {
      const bool used = k < count;
      const std::size_t from = used ? k : 0;
      const Vec3 d(dx[from], dy[from], dz[from]);
      const bool sound = inRange(d) & (std::abs(d.x) + std::abs(d.y) + std::abs(d.z) > 0);
      refused += used && !sound;
      valid[k] = used && sound ? -1 : 0;
      rays.org_x[k] = origin.x, rays.org_y[k] = origin.y, rays.org_z[k] = origin.z;
      rays.dir_x[k] = sound ? d.x : 1.0f, rays.dir_y[k] = sound ? d.y : 0.0f,
      rays.dir_z[k] = sound ? d.z : 0.0f;
      rays.tnear[k] = 0, rays.tfar[k] = std::numeric_limits<float>::infinity();
      rays.mask[k] = 0xffffffffu, rays.time[k] = 0, rays.id[k] = 0, rays.flags[k] = 0;
    }
    return refused;
  }

  /// The same from rays that have little in common; one with no length is switched off and not refused.
  int load(RTCRay16& query, std::span<const Ray> rays) {
    int refused = 0;
    for (std::size_t k = 0; k < kPacket; ++k) {
      static const Ray harmless{Vec3(0), 0, Vec3(1, 0, 0)};
      const bool used = k < rays.size(), sound = used && usable(rays[k]);
      refused += used && !sound;
      valid[k] = sound && rays[k].tFar >= rays[k].tNear ? -1 : 0;
      const Ray& ray = valid[k] ? rays[k] : harmless;
      query.org_x[k] = ray.origin.x, query.org_y[k] = ray.origin.y, query.org_z[k] = ray.origin.z;
      query.dir_x[k] = ray.direction.x, query.dir_y[k] = ray.direction.y, query.dir_z[k] = ray.direction.z;
      query.tnear[k] = ray.tNear, query.tfar[k] = ray.tFar;
      query.mask[k] = 0xffffffffu, query.time[k] = 0, query.id[k] = 0, query.flags[k] = 0;
    }
    return refused;
  }

  void intersect(RTCScene scene, RTCIntersectContext& context, RTCRayHit16& query) {
    std::fill(std::begin(query.hit.geomID), std::end(query.hit.geomID), RTC_INVALID_GEOMETRY_ID);
    rtcIntersect16(valid, scene, &context, &query);
  }
};

Hit hitOf(const RTCRayHit16& query, std::size_t k, const Vec3& direction) {
  if (query.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) return {};
  return {
      query.hit.primID[k],
      query.ray.tfar[k],
      {query.hit.u[k], query.hit.v[k]},
      query.hit.Ng_x[k] * direction.x + query.hit.Ng_y[k] * direction.y + query.hit.Ng_z[k] * direction.z >
          0};
}

/// Packets share an origin and, when sorted, a narrow cone: the frustum traversal that this flag turns
/// on was the fastest for both queries (single thread, 21 000 to 360 000 triangles: 8 to 15 million rays
/// a second against 4 to 6 for single rays). It changes speed only.
RTCIntersectContext packetContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

/// Owns a scene of Embree's.
struct SceneHandle {
  RTCScene scene = rtcNewScene(device());

  SceneHandle() {
    if (!scene) throw ResourceError("ray tracing scene cannot be created", "Embree", "free some memory");
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  }
  ~SceneHandle() { rtcReleaseScene(scene); }
  SceneHandle(const SceneHandle&) = delete;
  SceneHandle& operator=(const SceneHandle&) = delete;
  operator RTCScene() const { return scene; }
};

/// Where a periodic surface is whole although it has finitely many copies, and how rays go on from there.
class Torus {
 public:
  Torus() = default;
  Torus(const Box3& bounds, float width) : width_(width) {
    const Vec3 extent = bounds.high - bounds.low;
    if (!(width > 0) || !(std::max(extent.x, extent.y) <= 1.5f * width))
      throw ValueError("one period sticks out too far over the next", "ray scene",
                       "cut it, or use a larger period");
    cell_ = bounds.center() - 0.5f * width;
    const float reach = float(kCopies + 1) * width;
    low_ = bounds.high - reach, high_ = bounds.low + reach;
    low_.z = bounds.low.z, high_.z = bounds.high.z;
  }

  static constexpr int kCopies = 1;  // to each side
  explicit operator bool() const { return width_ > 0; }

  /// The same point in the middle copy.
  Vec3 wrapped(Vec3 p) const {
    for (int axis = 0; axis < 2; ++axis)
      if (const float periods = std::floor((p[axis] - cell_[axis]) / width_); periods != 0)
        p[axis] -= periods * width_;
    return p;
  }
  /// Moves a ray that met nothing to where the copies end and returns how far that was; 0 when it leaves the
  /// layer before.
  float advance(Ray& ray) const {
    const Vec3 &o = ray.origin, &d = ray.direction;
    const auto until = [&](int axis) {
      if (d[axis] == 0) return std::numeric_limits<float>::infinity();
      return ((d[axis] > 0 ? high_ : low_)[axis] - o[axis]) / d[axis];
    };
    const float side = std::min(until(0), until(1));
    if (!(side < until(2)) || !(side < ray.tFar) || !(side > 0)) return 0;
    // A little less than the whole way, so that nothing at the border is lost; nothing lies on that bit.
    const float step = 0.999f * side;
    ray.origin = wrapped(o + step * d);
    ray.tFar -= step, ray.tNear = 0;
    return step;
  }

 private:
  float width_ = 0;
  Vec3 cell_{0}, low_{0}, high_{0};
};

constexpr int kMostSteps = 500;

}  // namespace

struct RayScene::Impl {
  std::unique_ptr<SceneHandle> scene = std::make_unique<SceneHandle>();
  std::unique_ptr<SceneHandle> copied;  // what a periodic scene is made of
  Torus torus;
  float size = 0;
  mutable std::atomic<std::uint64_t> refused{0};

  explicit Impl(const Scene& from, Job* job) : size(from.mesh.bounds().diagonal()) {
    checkPositions(from);
    fill(from, *scene);
    commit(*scene, job);
  }

  Impl(const Scene& from, float width, Job* job) : Impl(from, job) {
    torus = Torus(from.mesh.bounds(), width);
    copied = std::exchange(scene, std::make_unique<SceneHandle>());
    for (int y = -Torus::kCopies; y <= Torus::kCopies; ++y)
      for (int x = -Torus::kCopies; x <= Torus::kCopies; ++x)
        addCopy(Vec3(float(x) * width, float(y) * width, 0));
    commit(*scene, job);
  }

  void addCopy(const Vec3& move) {
    const RTCGeometry copy = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_INSTANCE);
    if (!copy) throw ResourceError("no memory for the ray tracing scene", "Embree", "simplify the mesh");
    const float matrix[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, move.x, move.y, move.z};
    rtcSetGeometryInstancedScene(copy, *copied);
    rtcSetGeometryTransform(copy, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
    rtcCommitGeometry(copy);
    rtcAttachGeometry(*scene, copy);
    rtcReleaseGeometry(copy);
  }

  void fill(const Scene& from, RTCScene to) {
    rtcSetSceneBuildQuality(to, RTC_BUILD_QUALITY_HIGH);
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    if (!geometry) throw ResourceError("no memory for the ray tracing scene", "Embree", "simplify the mesh");
    try {
      rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_HIGH);
      fillBuffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, from.mesh.positions);
      fillBuffer<unsigned>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, from.mesh.triangles);
    } catch (...) {
      rtcReleaseGeometry(geometry);
      throw;
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(to, geometry);
    rtcReleaseGeometry(geometry);
  }

  static void commit(RTCScene built, Job* job) {
    if (job) rtcSetSceneProgressMonitorFunction(built, &Impl::goOn, job);
    rtcGetDeviceError(device());  // forget errors of others
    rtcCommitScene(built);
    const RTCError error = rtcGetDeviceError(device());
    if (job && job->cancelled()) throw Cancelled();
    rtcSetSceneProgressMonitorFunction(built, nullptr, nullptr);
    if (error == RTC_ERROR_OUT_OF_MEMORY)
      throw ResourceError("no memory for the ray tracing scene", "Embree",
                          "simplify the mesh or free some memory");
    if (error != RTC_ERROR_NONE)
      throw ResourceError("building the ray tracing scene failed with code " + std::to_string(int(error)),
                          "Embree", "repair the mesh");
  }

  static bool goOn(void* job, double) { return !static_cast<Job*>(job)->cancelled(); }

  void refuse(std::uint64_t count) const {
    if (count) refused.fetch_add(count, std::memory_order_relaxed);
  }

  /// The first hit of a usable ray among the copies that there are.
  Hit first(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{};
    query.ray = embreeRay(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(*scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.hit.primID,
            query.ray.tfar,
            {query.hit.u, query.hit.v},
            dot(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z), ray.direction) > 0};
  }

  /// The hit of a ray that has met nothing so far.
  Hit beyond(Ray ray) const {
    float gone = 0;
    for (int i = 0; torus && i < kMostSteps; ++i) {
      const float step = torus.advance(ray);
      if (step == 0) break;
      gone += step;
      if (Hit hit = first(ray); hit.valid()) return hit.t += gone, hit;
    }
    return {};
  }

  Vec3 startOf(const Vec3& origin) const { return torus ? torus.wrapped(origin) : origin; }
};

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>(scene, nullptr)) {}
RayScene::RayScene(const Scene& scene, Job& job) : impl_(std::make_unique<Impl>(scene, &job)) {}
RayScene::RayScene(const Scene& scene, const Periodic& periodic, Job& job)
    : impl_(std::make_unique<Impl>(scene, periodic.width, &job)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

bool RayScene::occluded(const Ray& given) const {
  if (!usable(given)) return impl_->refuse(1), false;
  if (given.tFar < given.tNear) return false;
  Ray ray = given;
  ray.origin = impl_->startOf(ray.origin);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = embreeRay(ray);
  rtcOccluded1(*impl_->scene, &context, &query);
  if (query.tfar < 0) return true;  // Embree marks a blocked ray with minus infinity
  return impl_->beyond(ray).valid();
}

Hit RayScene::intersect(const Ray& given) const {
  if (!usable(given)) return impl_->refuse(1), Hit{};
  if (given.tFar < given.tNear) return {};
  Ray ray = given;
  ray.origin = impl_->startOf(ray.origin);
  const Hit hit = impl_->first(ray);
  return hit.valid() ? hit : impl_->beyond(ray);
}

void RayScene::occludedFrom(const Vec3& origin, std::span<const float> dx, std::span<const float> dy,
                            std::span<const float> dz, std::span<std::uint8_t> blocked) const {
  const std::size_t n = dx.size();
  if (dy.size() != n || dz.size() != n || blocked.size() != n)
    throw ValueError("directions and results differ in number", "ray scene", "give spans of one size");
  std::fill(blocked.begin(), blocked.end(), std::uint8_t{0});
  if (!inRange(origin)) return impl_->refuse(n);
  const Vec3 start = impl_->startOf(origin);
  RTCIntersectContext context = packetContext();
  std::uint64_t refused = 0;
  for (std::size_t i = 0; i < n; i += kPacket) {
    const std::size_t count = std::min(kPacket, n - i);
    Packet packet;
    RTCRay16 rays;
    refused += packet.load(rays, start, &dx[i], &dy[i], &dz[i], count);
    rtcOccluded16(packet.valid, *impl_->scene, &context, &rays);
    for (std::size_t k = 0; k < count; ++k)
      blocked[i + k] =
          packet.valid[k] &&
          (rays.tfar[k] < 0 || impl_->beyond({start, 0, Vec3(dx[i + k], dy[i + k], dz[i + k])}).valid());
  }
  impl_->refuse(refused);
}

void RayScene::intersectFrom(const Vec3& origin, std::span<const float> dx, std::span<const float> dy,
                             std::span<const float> dz, std::span<Hit> hits) const {
  const std::size_t n = dx.size();
  if (dy.size() != n || dz.size() != n || hits.size() != n)
    throw ValueError("directions and results differ in number", "ray scene", "give spans of one size");
  std::fill(hits.begin(), hits.end(), Hit{});
  if (!inRange(origin)) return impl_->refuse(n);
  const Vec3 start = impl_->startOf(origin);
  RTCIntersectContext context = packetContext();
  std::uint64_t refused = 0;
  for (std::size_t i = 0; i < n; i += kPacket) {
    const std::size_t count = std::min(kPacket, n - i);
    Packet packet;
    RTCRayHit16 query;
    refused += packet.load(query.ray, start, &dx[i], &dy[i], &dz[i], count);
    packet.intersect(*impl_->scene, context, query);
    for (std::size_t k = 0; k < count; ++k) {
      if (!packet.valid[k]) continue;
      const Vec3 d(dx[i + k], dy[i + k], dz[i + k]);
      const Hit hit = hitOf(query, k, d);
      hits[i + k] = hit.valid() ? hit : impl_->beyond({start, 0, d});
    }
  }
  impl_->refuse(refused);
}

void RayScene::intersectRays(std::span<const Ray> rays, std::span<Hit> hits) const {
  if (rays.size() != hits.size())
    throw ValueError("rays and results differ in number", "ray scene", "give spans of one size");
  std::fill(hits.begin(), hits.end(), Hit{});
  RTCIntersectContext context = packetContext();
  std::uint64_t refused = 0;
  for (std::size_t i = 0; i < rays.size(); i += kPacket) {
    const std::size_t count = std::min(kPacket, rays.size() - i);
    Packet packet;
    RTCRayHit16 query;
    std::array<Ray, kPacket> moved;
    for (std::size_t k = 0; k < count; ++k) {
      moved[k] = rays[i + k];
      if (usable(moved[k])) moved[k].origin = impl_->startOf(moved[k].origin);
    }
    refused += packet.load(query.ray, std::span(moved).first(count));
    packet.intersect(*impl_->scene, context, query);
    for (std::size_t k = 0; k < count; ++k) {
      if (!packet.valid[k]) continue;
      const Hit hit = hitOf(query, k, moved[k].direction);
      hits[i + k] = hit.valid() ? hit : impl_->beyond(moved[k]);
    }
  }
  impl_->refuse(refused);
}

std::uint64_t RayScene::refusedRays() const {
  return impl_->refused.load(std::memory_order_relaxed);
}

float RayScene::size() const {
  return impl_->size;
}

Vec3 offsetOrigin(const Vec3& a, const Vec3& b, const Vec3& c, const Vec2& barycentric, const Vec3& n) {
  constexpr float kRounding = 0x1p-24f;
  const float first = 1 - barycentric.x - barycentric.y;
  const Vec3 p = first * a + barycentric.x * b + barycentric.y * c;
  const Vec3 size = std::abs(first) * abs(a) + barycentric.x * abs(b) + barycentric.y * abs(c);
  // A plane along an axis has no rounding error; the last term still takes the point off it.
  const Vec3 most = max(max(abs(a), abs(b)), abs(c));
  const float distance = 16 * kRounding * dot(abs(n), size) + 1e-9f * std::max({most.x, most.y, most.z});
  Vec3 moved = p + distance * n;
  for (int axis = 0; axis < 3; ++axis)  // adding may have rounded to nothing
    if (moved[axis] == p[axis] && std::abs(n[axis]) * distance > 0.25f * kRounding * size[axis])
      moved[axis] = std::nextafter(p[axis], std::copysign(std::numeric_limits<float>::infinity(), n[axis]));
  return moved;
}

Vec3 offsetOrigin(const Vec3& p, const Vec3& n, float sceneSize) {
  constexpr float kNearZero = 1.0f / 32, kStep = 1.0f / 65536, kUlps = 256;
  Vec3 moved;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(p[axis]) < kNearZero * sceneSize) {
      moved[axis] = p[axis] + kStep * sceneSize * n[axis];
      continue;
    }
    const int ulps = int(kUlps * n[axis]);
    const auto bits = std::bit_cast<std::int32_t>(p[axis]);
    moved[axis] = std::bit_cast<float>(bits + (p[axis] < 0 ? -ulps : ulps));
  }
  return moved;
}

}  // namespace prt
