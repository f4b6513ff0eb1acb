#include "libprt/transport/path_tracer.h"

#include "libprt/core/error.h"
#include "libprt/core/parallel.h"
#include "libprt/material/bsdf.h"

#include <algorithm>
#include <cmath>

namespace prt {
namespace {

constexpr float kHorizon = 1e-3f;  // least cosine of a view that counts as above the shading horizon

/// Weight of a sample drawn with density `own` where another technique has density `other` (exponent 2).
float powerHeuristic(float own, float other) {
  if (!(own < 1e18f)) return 1;
  const float a = own * own, b = other * other;
  return a > 0 ? a / (a + b) : 0;
}

bool black(const Rgb& c) {
  return !(c.x > 0 || c.y > 0 || c.z > 0);
}

/// A direction in the upper half of the local frame: what lies below the horizon is lifted onto it.
Vec3 lifted(Vec3 local) {
  if (local.z >= kHorizon) return local;
  local.z = kHorizon;
  return normalize(local);
}

/// f * cosine for light from `in`, 0 where the geometric surface hides it.
struct Response {
  Rgb value{0};
  float pdf = 0;  ///< with which BRDF sampling draws `in`
};

}  // namespace

/// A point where light is gathered: a surface, or a receiver of irradiance.
struct PathTracer::Vertex {
  Vec3 origin{0};                      // where rays start
  Vec3 geometricNormal{0};             // on the side that is seen
  Frame frame;                         // about the shading normal
  Vec3 out{0, 0, 1};                   // local, towards the viewer
  const Material* material = nullptr;  // null: nothing is reflected from here

  Response respond(const Vec3& direction) const {
    const Vec3 in = frame.toLocal(direction);
    if (in.z <= 0 || dot(direction, geometricNormal) <= 0) return {};
    return {evalBrdf(*material, in, out) * in.z, pdfBrdf(*material, in, out)};
  }
};

PathTracer::PathTracer(const Scene& scene, const LightRig& lights, Job& job, std::vector<Rgb> emission)
    : scene_(scene),
      rays_(scene, job),
      lights_(lights),
      diffuse_(scene.materials),
      emission_(std::move(emission)) {
  if (!emission_.empty() && emission_.size() != scene.materials.size())
    throw ValueError("emission is not given for every object", "path tracer", "give one for each");
  for (Material& m : diffuse_) m.specular = Rgb(0);
  receiver_.albedo = Rgb(kPiF);  // a BRDF of 1: what is reflected is the irradiance
}

PathTracer::Vertex PathTracer::vertexAt(const Hit& hit, const Vec3& direction, bool first,
                                        const PathOptions& options) const {
  const TriMesh& mesh = scene_.mesh;
  const UVec3& t = mesh.triangles[hit.triangle];
  const Vec3& p0 = mesh.positions[t.x];
  const Vec3 e1 = mesh.positions[t.y] - p0, e2 = mesh.positions[t.z] - p0;
  const Vec2 b = hit.barycentric;

  Vertex v;
  const DVec3 area = cross(DVec3(e1), DVec3(e2));
  const Vec3 face(area / length(area));
  const bool back = dot(face, direction) > 0;
  const std::uint32_t object = scene_.triangleObject[hit.triangle];
  if (!isFinite(face) || (back && !scene_.materials[object].twoSided)) return v;

  const float side = back ? -1.0f : 1.0f;
  const Vec3 smooth = (1 - b.x - b.y) * mesh.normals[t.x] + b.x * mesh.normals[t.y] + b.y * mesh.normals[t.z];
  const float size = length(smooth);
  v.material = !first && options.diffuseBounces ? &diffuse_[object] : &scene_.materials[object];
  v.geometricNormal = side * face;
  v.frame = frameFromNormal(size > 1e-6f ? side / size * smooth : side * face);
  v.out = lifted(v.frame.toLocal(-direction));
  v.origin = offsetOrigin(p0, mesh.positions[t.y], mesh.positions[t.z], b, v.geometricNormal);
  return v;
}

/// Light sampled directly, weighed against BRDF sampling; directional lights, which only this can find.
Rgb PathTracer::nextEvent(const Vertex& v, const Vec2& u) const {
  Rgb sum(0);
  const LightSample light = lights_.sample(u);
  if (light.pdf > 0) {
    const Response r = v.respond(light.direction);
    if (!black(r.value * light.radiance) && !rays_.occluded({v.origin, 0, light.direction}))
      sum += r.value * light.radiance * (powerHeuristic(light.pdf, r.pdf) / light.pdf);
  }
  for (const DirectionalLight& sun : lights_.directionals()) {
    const Vec3 direction = normalize(sun.direction);
    const Response r = v.respond(direction);
    if (!black(r.value * sun.irradiance) && !rays_.occluded({v.origin, 0, direction}))
      sum += r.value * sun.irradiance;
  }
  return sum;
}

/// What shines of its own where a ray meets the scene.
Rgb PathTracer::emitted(const Hit& hit, const Vec3& direction) const {
  if (emission_.empty()) return Rgb(0);
  const std::uint32_t object = scene_.triangleObject[hit.triangle];
  const bool back = dot(scene_.mesh.areaNormal(hit.triangle), direction) > 0;
  return back && !scene_.materials[object].twoSided ? Rgb(0) : emission_[object];
}

Rgb PathTracer::gather(Vertex v, const PathOptions& options, SobolStream& stream) const {
  Rgb sum(0), throughput(1);
  for (int bounce = 0; v.material; ++bounce) {
    sum += throughput * nextEvent(v, stream.next2());

    // One more ray: what it finds of the light completes next-event estimation, what it hits goes on.
    const Vec2 u = stream.next2();
    const BrdfSample next = sampleBrdf(*v.material, v.out, u, v.material->glossy() ? stream.next() : 0.0f);
    const Vec3 direction = v.frame.toWorld(next.in);
    const Rgb weight = throughput * next.weight;
    if (!(next.pdf > 0) || black(weight) || dot(direction, v.geometricNormal) <= 0) break;
    const Ray ray{v.origin, 0, direction};
    const bool last = bounce == options.bounces;
    const bool looks = !last || !emission_.empty();
    const Hit hit = looks ? rays_.intersect(ray) : Hit{};
    if (looks ? !hit.valid() : !rays_.occluded(ray)) {
      sum += weight * lights_.radiance(direction) * powerHeuristic(next.pdf, lights_.pdf(direction));
      break;
    }
    if (looks) sum += weight * emitted(hit, direction);
    if (last) break;
    throughput = weight;
    v = vertexAt(hit, direction, false, options);
  }
  return isFinite(sum) ? sum : Rgb(0);
}

PathSample PathTracer::trace(const Ray& ray, const PathOptions& options, SobolStream& stream) const {
  const Hit hit = rays_.intersect(ray);
  if (!hit.valid()) return {lights_.radiance(ray.direction), false};
  const Rgb own = emitted(hit, ray.direction);
  return {own + gather(vertexAt(hit, ray.direction, true, options), options, stream), true};
}

Rgb PathTracer::irradiance(const SampleSet& samples, std::size_t index, const PathOptions& options,
                           SobolStream& stream) const {
  Vertex v;
  v.origin = samples.origin[index];
  v.geometricNormal = samples.geometricNormal[index];
  v.frame = frameFromNormal(samples.shadingNormal[index]);
  v.material = &receiver_;
  return gather(v, options, stream);
}

SampleIrradiance irradianceAtSamples(const PathTracer& tracer, const SampleSet& samples,
                                     std::span<const std::uint32_t> indices, int paths,
                                     const PathOptions& options, Job& job) {
  const std::size_t count = indices.empty() ? samples.size() : indices.size();
  SampleIrradiance result{std::vector<Rgb>(count), std::vector<Rgb>(count)};
  job.begin("path tracing at samples", double(count) * paths, "paths");
  parallelFor(job, 0, count, 1, [&](std::size_t i, std::size_t) {
    const std::size_t sample = indices.empty() ? i : indices[i];
    DVec3 sum(0), squares(0);
    for (int path = 0; path < paths; ++path) {
      if (path % 256 == 0) job.checkCancelled();
      SobolStream stream(hashBits(options.seed, sample), std::uint32_t(path));
      const DVec3 value(tracer.irradiance(samples, sample, options, stream));
      sum += value, squares += value * value;
    }
    const double n = std::max(paths, 1);
    const DVec3 mean = sum / n;
    result.mean[i] = Rgb(mean);
    result.standardError[i] = Rgb(sqrt(max(squares / n - mean * mean, DVec3(0)) / std::max(n - 1, 1.0)));
    job.advance(paths);
  });
  return result;
}

}  // namespace prt
