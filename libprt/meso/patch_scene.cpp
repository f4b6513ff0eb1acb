#include "libprt/meso/patch_scene.h"

#include "libprt/meso/torus_vertices.h"

#include <cmath>
#include <set>
#include <unordered_map>

namespace prt {
namespace {

Scene sceneOf(const TriMesh& mesh) {
  Scene scene;
  scene.mesh = mesh;
  scene.triangleObject.assign(mesh.triangleCount(), 0);
  scene.vertexObject.assign(mesh.vertexCount(), 0);
  scene.materials = {Material{}};
  scene.names = {"patch"};
  return scene;
}

/// The mesh with the triangles that its vertices miss because they lie a period away, so that every vertex
/// has all its faces around it.
class Padding {
 public:
  Padding(const TriMesh& mesh, Job& job)
      : mesh_(mesh), padded_(mesh), places_(torusPlaces(mesh.positions, &job)) {}

  TriMesh run() {
    // Only places with more than one vertex matter: the seams.
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> verticesAt, trianglesAt;
    for (std::uint32_t v = 0; v < mesh_.vertexCount(); ++v)
      if (places_[v] != v) verticesAt[places_[v]].push_back(v);
    for (auto& [place, vertices] : verticesAt) {
      vertices.insert(vertices.begin(), place);
      for (const std::uint32_t v : vertices) {
        trianglesAt[v];
        cells_.try_emplace({place, periods(v, place, 0), periods(v, place, 1)}, v);
      }
    }
    for (std::uint32_t t = 0; t < mesh_.triangleCount(); ++t)
      for (int k = 0; k < 3; ++k)
        if (const auto found = trianglesAt.find(mesh_.triangles[t][k]); found != trianglesAt.end())
          found->second.push_back(t);
    for (std::uint32_t v = 0; v < mesh_.vertexCount(); ++v) {
      const auto group = verticesAt.find(places_[v]);
      if (group == verticesAt.end()) continue;
      for (const std::uint32_t other : group->second) {
        const int x = periods(v, other, 0), y = periods(v, other, 1);
        if (x == 0 && y == 0) continue;
        for (const std::uint32_t t : trianglesAt.at(other)) addCopy(t, x, y);
      }
    }
    return std::move(padded_);
  }

 private:
  /// Whole periods from vertex b to vertex a.
  int periods(std::uint32_t a, std::uint32_t b, int axis) const {
    return int(std::lround(mesh_.positions[a][axis] - mesh_.positions[b][axis]));
  }

  void addCopy(std::uint32_t triangle, int x, int y) {
    if (!copied_.emplace(triangle, x, y).second) return;
    UVec3 made;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh_.triangles[triangle][k];
      made[k] = vertices_.at(v, x, y, [&] {
        padded_.positions.push_back(position(v, x, y));
        padded_.normals.push_back(mesh_.normals[v]);
        return std::uint32_t(padded_.positions.size() - 1);
      });
    }
    padded_.triangles.push_back(made);
  }

  /// Exactly the position of a vertex that is there already, if one is: samples look for equal ones.
  Vec3 position(std::uint32_t v, int x, int y) {
    const auto found =
        cells_.find({places_[v], periods(v, places_[v], 0) + x, periods(v, places_[v], 1) + y});
    if (found != cells_.end()) return mesh_.positions[found->second];
    return mesh_.positions[v] + Vec3(float(x), float(y), 0);
  }

  const TriMesh& mesh_;
  TriMesh padded_;
  std::vector<std::uint32_t> places_;
  TorusVertexMap vertices_;
  std::map<std::tuple<std::uint32_t, int, int>, std::uint32_t> cells_;
  std::set<std::tuple<std::uint32_t, int, int>> copied_;
};

}  // namespace

PatchScene makePatchRays(std::shared_ptr<const Patch> patch, Job& job) {
  PatchScene out;
  out.scene = std::make_shared<Scene>(sceneOf(patch->mesh));
  out.rays = std::make_shared<RayScene>(*out.scene, Periodic{}, job);
  out.patch = std::move(patch);
  return out;
}

PatchScene makePatchScene(std::shared_ptr<const Patch> from, Job& job) {
  PatchScene out = makePatchRays(std::move(from), job);
  const auto& patch = out.patch;
  std::vector<std::uint32_t> firsts;
  std::vector<std::uint32_t> number(patch->twin.size());
  for (std::uint32_t v = 0; v < patch->twin.size(); ++v)
    if (patch->twin[v] == v) number[v] = std::uint32_t(firsts.size()), firsts.push_back(v);
  for (const std::uint32_t twin : patch->twin) out.sampleOf.push_back(number[twin]);
  out.samples = std::make_shared<SampleSet>(
      someSamples(samplesAtVertices(sceneOf(Padding(patch->mesh, job).run()), &job), firsts));
  job.checkCancelled();
  return out;
}

Ray viewRay(const Patch& patch, const Vec2& uv, const Vec3& view) {
  const float up = 0.5f * patch.depth() + 1e-3f;
  return {Vec3(uv, patch.middle()) + view * (up / view.z), 0, -view};
}

}  // namespace prt
