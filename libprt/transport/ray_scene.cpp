#include "libprt/transport/ray_scene.h"

#include "libprt/core/error.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>

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
};

/// Packets share an origin and, when sorted, a narrow cone: the frustum traversal that this flag turns
/// on was the fastest for both queries (single thread, 21 000 to 360 000 triangles: 8 to 15 million rays
/// a second against 4 to 6 for single rays). It changes speed only.
RTCIntersectContext packetContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

}  // namespace

struct RayScene::Impl {
  RTCScene scene = nullptr;
  float size = 0;
  mutable std::atomic<std::uint64_t> refused{0};

  explicit Impl(const Scene& from, Job* job) : size(from.mesh.bounds().diagonal()) {
    checkPositions(from);
    scene = rtcNewScene(device());
    if (!scene) throw ResourceError("ray tracing scene cannot be created", "Embree", "free some memory");
    try {
      fill(from);
      commit(job);
    } catch (...) {
      rtcReleaseScene(scene);
      throw;
    }
  }
  ~Impl() { rtcReleaseScene(scene); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void fill(const Scene& from) {
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
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
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
  }

  void commit(Job* job) {
    if (job) rtcSetSceneProgressMonitorFunction(scene, &Impl::goOn, job);
    rtcGetDeviceError(device());  // forget errors of others
    rtcCommitScene(scene);
    const RTCError error = rtcGetDeviceError(device());
    if (job && job->cancelled()) throw Cancelled();
    rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
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
};

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>(scene, nullptr)) {}
RayScene::RayScene(const Scene& scene, Job& job) : impl_(std::make_unique<Impl>(scene, &job)) {}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

bool RayScene::occluded(const Ray& ray) const {
  if (!usable(ray)) return impl_->refuse(1), false;
  if (ray.tFar < ray.tNear) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = embreeRay(ray);
  rtcOccluded1(impl_->scene, &context, &query);
  return query.tfar < 0;  // Embree marks a blocked ray with minus infinity
}

Hit RayScene::intersect(const Ray& ray) const {
  if (!usable(ray)) return impl_->refuse(1), Hit{};
  if (ray.tFar < ray.tNear) return {};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = embreeRay(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {query.hit.primID,
          query.ray.tfar,
          {query.hit.u, query.hit.v},
          dot(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z), ray.direction) > 0};
}

void RayScene::occludedFrom(const Vec3& origin, std::span<const float> dx, std::span<const float> dy,
                            std::span<const float> dz, std::span<std::uint8_t> blocked) const {
  const std::size_t n = dx.size();
  if (dy.size() != n || dz.size() != n || blocked.size() != n)
    throw ValueError("directions and results differ in number", "ray scene", "give spans of one size");
  std::fill(blocked.begin(), blocked.end(), std::uint8_t{0});
  if (!inRange(origin)) return impl_->refuse(n);
  RTCIntersectContext context = packetContext();
  std::uint64_t refused = 0;
  for (std::size_t i = 0; i < n; i += kPacket) {
    const std::size_t count = std::min(kPacket, n - i);
    Packet packet;
    RTCRay16 rays;
    refused += packet.load(rays, origin, &dx[i], &dy[i], &dz[i], count);
    rtcOccluded16(packet.valid, impl_->scene, &context, &rays);
    for (std::size_t k = 0; k < count; ++k) blocked[i + k] = packet.valid[k] && rays.tfar[k] < 0;
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
  RTCIntersectContext context = packetContext();
  std::uint64_t refused = 0;
  for (std::size_t i = 0; i < n; i += kPacket) {
    const std::size_t count = std::min(kPacket, n - i);
    Packet packet;
    RTCRayHit16 query;
    std::fill(std::begin(query.hit.geomID), std::end(query.hit.geomID), RTC_INVALID_GEOMETRY_ID);
    refused += packet.load(query.ray, origin, &dx[i], &dy[i], &dz[i], count);
    rtcIntersect16(packet.valid, impl_->scene, &context, &query);
    for (std::size_t k = 0; k < count; ++k)
      if (packet.valid[k] && query.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID)
        hits[i + k] = {
            query.hit.primID[k],
            query.ray.tfar[k],
            {query.hit.u[k], query.hit.v[k]},
            query.hit.Ng_x[k] * dx[i + k] + query.hit.Ng_y[k] * dy[i + k] + query.hit.Ng_z[k] * dz[i + k] >
                0};
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
