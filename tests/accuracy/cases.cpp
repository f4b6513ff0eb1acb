#include "tests/accuracy/cases.h"

#include "libprt/core/sampling.h"
#include "libprt/light/environment_io.h"
#include "libprt/light/projection.h"
#include "libprt/mesh/repair.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numeric>

namespace prt::test {

bool fullRun() {
  return std::getenv("PRT_FULL") != nullptr;
}

Model loadModel(const std::string& file) {
  Job job;
  Material material;
  material.albedo = {0.8f, 0.5f, 0.3f};
  const auto mesh = std::make_shared<TriMesh>(loadMesh(sharedData("meshes/" + file), {}, job));
  const SceneObject object{file, mesh, Mat4(1.0f), material};
  Model model;
  model.name = std::filesystem::path(file).stem().string();
  const auto scene = std::make_shared<Scene>(flattenScene({&object, 1}));
  model.scene = scene;
  model.rays = std::make_shared<RayScene>(*scene, job);
  model.samples = std::make_shared<SampleSet>(samplesAtVertices(*scene));
  return model;
}

Light loadLight(const std::string& file) {
  const EnvironmentMap probe = loadEnvironment(sharedData("probes/" + file));
  Light light;
  light.name = std::filesystem::path(file).stem().string();
  light.rig.environment = std::make_shared<EnvironmentMap>(
      bandLimitedMap(nonNegativeLight(projectEnvironment(probe, 5)), 256, 128));
  light.coefficients = projectLights(light.rig, 5);
  return light;
}

SampleSet subset(const SampleSet& samples, const std::vector<std::uint32_t>& indices) {
  SampleSet some;
  for (const std::uint32_t i : indices) {
    some.origin.push_back(samples.origin[i]);
    some.geometricNormal.push_back(samples.geometricNormal[i]);
    some.shadingNormal.push_back(samples.shadingNormal[i]);
    some.triangle.push_back(samples.triangle[i]);
    some.barycentric.push_back(samples.barycentric[i]);
  }
  return some;
}

std::vector<std::uint32_t> pick(std::size_t size, std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> all(size);
  std::iota(all.begin(), all.end(), 0u);
  std::sort(all.begin(), all.end(),
            [&](std::uint32_t a, std::uint32_t b) { return hashBits(seed, a) < hashBits(seed, b); });
  all.resize(std::min(size, count));
  std::sort(all.begin(), all.end());
  return all;
}

std::string caseName(const std::string& file) {
  std::string name = file.substr(0, file.find('.'));
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<float> flatten(const std::vector<Rgb>& colours) {
  std::vector<float> row;
  row.reserve(3 * colours.size());
  for (const Rgb& c : colours) row.insert(row.end(), {c.x, c.y, c.z});
  return row;
}

void report(const std::string& what, const NoiseFreeError& e) {
  std::printf("[ accuracy ] %-60s %.3f %%  [%.3f, %.3f]\n", what.c_str(), 100 * e.relative(),
              100 * e.relativeLow(), 100 * e.relativeHigh());
}

}  // namespace prt::test
