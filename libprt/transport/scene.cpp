#include "libprt/transport/scene.h"

#include "libprt/core/error.h"

#include <cmath>
#include <limits>

namespace prt {
namespace {

constexpr std::size_t kMaxVertices = std::size_t{1} << 31;

/// The linear part of an affine transform; refuses what cannot be inverted.
Mat3 checkedLinear(const SceneObject& object) {
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row)
      if (!std::isfinite(object.transform[column][row]))
        throw GeometryError("transform holds a value that is not finite", "object '" + object.name + "'",
                            "give 16 finite numbers");
  const Mat4& m = object.transform;
  if (m[0][3] != 0 || m[1][3] != 0 || m[2][3] != 0 || m[3][3] != 1)
    throw GeometryError("transform is not affine", "object '" + object.name + "'",
                        "its last row must be 0 0 0 1");
  const Mat3 linear(m);
  const glm::dmat3 exact(linear);
  const double size = length(exact[0]) * length(exact[1]) * length(exact[2]);
  if (!(std::abs(determinant(exact)) > 1e-7 * size))
    throw GeometryError("transform flattens the object", "object '" + object.name + "'",
                        "use a transform that can be inverted; no axis may be scaled to zero");
  return linear;
}

void checkMesh(const SceneObject& object) {
  const TriMesh& mesh = *object.mesh;
  if (mesh.normals.size() != mesh.vertexCount())
    throw GeometryError("mesh needs one normal per vertex", "object '" + object.name + "'",
                        "repair the mesh first");
  for (const UVec3& t : mesh.triangles)
    if (t.x >= mesh.vertexCount() || t.y >= mesh.vertexCount() || t.z >= mesh.vertexCount())
      throw GeometryError("triangle names a vertex that does not exist", "object '" + object.name + "'",
                          "repair the mesh first");
}

void appendVertices(const TriMesh& from, const Mat4& transform, const Mat3& linear, TriMesh& to) {
  // Normals are covectors: the inverse transpose keeps them outside, mirrored maps included.
  const glm::dmat3 normalMap = transpose(inverse(glm::dmat3(linear)));
  for (const Vec3& p : from.positions) to.positions.push_back(Vec3(transform * Vec4(p, 1)));
  for (const Vec3& n : from.normals) {
    const DVec3 turned = normalMap * DVec3(n);
    const double size = length(turned);
    to.normals.push_back(size > 0 ? Vec3(turned / size) : n);
  }
}

void appendTriangles(const TriMesh& from, std::uint32_t firstVertex, bool mirrored, TriMesh& to) {
  for (const UVec3& t : from.triangles) {
    const UVec3 moved = t + firstVertex;
    to.triangles.push_back(mirrored ? UVec3(moved.x, moved.z, moved.y) : moved);
  }
}

/// Texture coordinates of an object in a scene where at least one object has some; an object without
/// gets (0, 0) everywhere.
void appendUv(const TriMesh& from, bool mirrored, TriMesh& to) {
  const auto first = std::uint32_t(to.uv.size());
  if (from.uv.empty()) {
    to.uv.emplace_back(0.0f);
    to.uvTriangles.insert(to.uvTriangles.end(), from.triangleCount(), UVec3(first));
    return;
  }
  to.uv.insert(to.uv.end(), from.uv.begin(), from.uv.end());
  for (const UVec3& t : from.uvTriangles)
    to.uvTriangles.push_back(mirrored ? UVec3(t.x, t.z, t.y) + first : t + first);
}

void checkResult(const Scene& scene, std::span<const SceneObject> objects) {
  for (std::size_t v = 0; v < scene.mesh.vertexCount(); ++v)
    if (!isFinite(scene.mesh.positions[v]))
      throw GeometryError("a vertex is not finite", "object '" + objects[scene.vertexObject[v]].name + "'",
                          "repair the mesh, or use a smaller scale");
}

}  // namespace

Scene flattenScene(std::span<const SceneObject> objects) {
  std::size_t vertices = 0, triangles = 0;
  bool anyUv = false;
  for (const SceneObject& object : objects) {
    if (!object.mesh)
      throw GeometryError("object has no mesh", "object '" + object.name + "'", "load one first");
    vertices += object.mesh->vertexCount();
    triangles += object.mesh->triangleCount();
    anyUv = anyUv || !object.mesh->uv.empty();
  }
  if (triangles == 0) throw GeometryError("scene has no triangles", "scene", "add an object with a surface");
  if (vertices >= kMaxVertices || triangles >= kMaxVertices)
    throw GeometryError("scene has " + std::to_string(vertices) + " vertices and " +
                            std::to_string(triangles) + " triangles, too many for one bake",
                        "scene", "simplify or split it");

  for (const SceneObject& object : objects) checkMesh(object);

  Scene scene;
  scene.mesh.positions.reserve(vertices);
  scene.mesh.normals.reserve(vertices);
  scene.mesh.triangles.reserve(triangles);
  for (std::uint32_t index = 0; index < objects.size(); ++index) {
    const SceneObject& object = objects[index];
    const Mat3 linear = checkedLinear(object);
    const bool mirrored = determinant(glm::dmat3(linear)) < 0;
    const auto firstVertex = std::uint32_t(scene.mesh.vertexCount());
    appendVertices(*object.mesh, object.transform, linear, scene.mesh);
    appendTriangles(*object.mesh, firstVertex, mirrored, scene.mesh);
    if (anyUv) appendUv(*object.mesh, mirrored, scene.mesh);
    scene.vertexObject.resize(scene.mesh.vertexCount(), index);
    scene.triangleObject.resize(scene.mesh.triangleCount(), index);
    scene.materials.push_back(object.material);
    scene.names.push_back(object.name);
  }
  checkResult(scene, objects);
  return scene;
}

}  // namespace prt
