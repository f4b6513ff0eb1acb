#include "libprt/mesh/half_edge.h"

#include "libprt/core/error.h"
#include "libprt/mesh/fans.h"
#include "libprt/mesh/weld.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace prt {

namespace {

struct BareTraits : OpenMesh::DefaultTraits {
  VertexAttributes(OpenMesh::Attributes::None);
  HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
  EdgeAttributes(OpenMesh::Attributes::None);
  FaceAttributes(OpenMesh::Attributes::None);
};

}  // namespace

struct HalfEdgeMesh::Kernel : OpenMesh::TriMesh_ArrayKernelT<BareTraits> {
  std::vector<UVec3> corners;  ///< [F] OpenMesh turns corners around, these stay as given

  /// The half-edge of a triangle that starts at its corner `side`.
  OpenMesh::HalfedgeHandle side(std::uint32_t triangle, int side) const {
    auto h = halfedge_handle(OpenMesh::FaceHandle(int(triangle)));
    while (std::uint32_t(from_vertex_handle(h).idx()) != corners[triangle][side]) h = next_halfedge_handle(h);
    return h;
  }

  /// Half-edges out of a vertex, counter-clockwise; at a boundary the one without a triangle on its left,
  /// which OpenMesh keeps as the vertex's own, comes last.
  std::vector<OpenMesh::HalfedgeHandle> spokes(std::uint32_t vertex) const {
    std::vector<OpenMesh::HalfedgeHandle> around;
    const auto own = halfedge_handle(OpenMesh::VertexHandle(static_cast<int>(vertex)));
    auto h = own;
    do {
      h = opposite_halfedge_handle(prev_halfedge_handle(h));
      around.push_back(h);
    } while (h != own);
    return around;
  }
};

HalfEdgeMesh::HalfEdgeMesh(const TriMesh& mesh, Job& job) : kernel_(std::make_unique<Kernel>()) {
  // Join vertices by position, then part what is no manifold.
  const std::vector<std::uint32_t> welded = weldByPosition(std::span<const Vec3>(mesh.positions), job);
  std::vector<UVec3> triangles;
  triangles.reserve(mesh.triangleCount());
  for (const UVec3& t : mesh.triangles) triangles.push_back({welded[t.x], welded[t.y], welded[t.z]});
  FanSplit fans = splitIntoFans(triangles, mesh.vertexCount(), job);

  // Number the vertices that triangles use.
  std::vector<std::uint32_t> number(fans.source.size(), kNoNeighbour);
  for (UVec3& t : fans.triangles)
    for (int i = 0; i < 3; ++i) {
      std::uint32_t& n = number[t[i]];
      if (n == kNoNeighbour) {
        n = std::uint32_t(meshVertex_.size());
        meshVertex_.push_back(fans.source[t[i]]);
      }
      t[i] = n;
    }
  kernel_->corners = std::move(fans.triangles);
  kernel_->reserve(meshVertex_.size(), 3 * meshVertex_.size(), kernel_->corners.size());
  for (std::uint32_t v : meshVertex_) {
    const Vec3& p = mesh.positions[v];
    kernel_->add_vertex({p.x, p.y, p.z});
  }
  for (std::size_t f = 0; f < kernel_->corners.size(); ++f) {
    if (f % 4096 == 0) job.checkCancelled();
    const UVec3& t = kernel_->corners[f];
    if (t.x == t.y || t.y == t.z || t.z == t.x)  // which OpenMesh would end the process for
      throw GeometryError("triangle " + std::to_string(f) + " has fewer than three different positions",
                          "half-edges", "repair the mesh first");
    kernel_->add_face(OpenMesh::VertexHandle(int(t.x)), OpenMesh::VertexHandle(int(t.y)),
                      OpenMesh::VertexHandle(int(t.z)));
  }
}

HalfEdgeMesh::~HalfEdgeMesh() = default;
HalfEdgeMesh::HalfEdgeMesh(HalfEdgeMesh&&) noexcept = default;
HalfEdgeMesh& HalfEdgeMesh::operator=(HalfEdgeMesh&&) noexcept = default;

std::size_t HalfEdgeMesh::vertexCount() const {
  return kernel_->n_vertices();
}
std::size_t HalfEdgeMesh::edgeCount() const {
  return kernel_->n_edges();
}
std::size_t HalfEdgeMesh::triangleCount() const {
  return kernel_->n_faces();
}

std::uint32_t HalfEdgeMesh::vertexOf(std::uint32_t triangle, int corner) const {
  return kernel_->corners[triangle][corner];
}

std::vector<std::uint32_t> HalfEdgeMesh::oneRing(std::uint32_t vertex) const {
  std::vector<std::uint32_t> ring;
  for (const auto h : kernel_->spokes(vertex))
    ring.push_back(std::uint32_t(kernel_->to_vertex_handle(h).idx()));
  return ring;
}

std::vector<std::uint32_t> HalfEdgeMesh::fan(std::uint32_t vertex) const {
  std::vector<std::uint32_t> triangles;
  for (const auto h : kernel_->spokes(vertex))
    if (!kernel_->is_boundary(h)) triangles.push_back(std::uint32_t(kernel_->face_handle(h).idx()));
  return triangles;
}

std::uint32_t HalfEdgeMesh::neighbour(std::uint32_t triangle, int side) const {
  const auto face = kernel_->opposite_face_handle(kernel_->side(triangle, side));
  return face.is_valid() ? std::uint32_t(face.idx()) : kNoNeighbour;
}

bool HalfEdgeMesh::isBoundary(std::uint32_t vertex) const {
  return kernel_->is_boundary(OpenMesh::VertexHandle(static_cast<int>(vertex)));
}

std::vector<std::vector<std::uint32_t>> HalfEdgeMesh::boundaryLoops() const {
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<bool> visited(kernel_->n_halfedges(), false);
  for (const auto start : kernel_->halfedges()) {
    if (!kernel_->is_boundary(start) || visited[std::size_t(start.idx())]) continue;
    std::vector<std::uint32_t>& loop = loops.emplace_back();
    OpenMesh::HalfedgeHandle h = start;
    do {
      visited[std::size_t(h.idx())] = true;
      loop.push_back(std::uint32_t(kernel_->from_vertex_handle(h).idx()));
      h = kernel_->next_halfedge_handle(h);
    } while (h != start);
  }
  return loops;
}

std::vector<std::uint32_t> HalfEdgeMesh::components() const {
  std::vector<std::uint32_t> component(triangleCount(), kNoNeighbour);
  std::uint32_t count = 0;
  std::vector<std::uint32_t> stack;
  for (std::uint32_t first = 0; first < component.size(); ++first) {
    if (component[first] != kNoNeighbour) continue;
    component[first] = count;
    for (stack.push_back(first); !stack.empty();) {
      const std::uint32_t f = stack.back();
      stack.pop_back();
      for (int side = 0; side < 3; ++side) {
        const std::uint32_t other = neighbour(f, side);
        if (other == kNoNeighbour || component[other] != kNoNeighbour) continue;
        component[other] = count;
        stack.push_back(other);
      }
    }
    ++count;
  }
  return component;
}

}  // namespace prt
