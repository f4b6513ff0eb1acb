#include "libprt/mesh/assemble.h"

#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/dense_index.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace prt {
namespace {

class Assembler {
 public:
  Assembler(const AssemblyInput& input, Job& job) : in_(input), check_(job) {}

  Assembly run() {
    triangles(orderedVertices());
    textureCoordinates();
    countVertices();
    return std::move(out_);
  }

 private:
  std::size_t fileVertices() const { return in_.soup.positions.size(); }

  /// Numbers every pair of position and normal, fills the mesh's vertices in the order of the file's
  /// vertices that the pairs stem from, and returns the vertex of each corner.
  std::vector<std::uint32_t> orderedVertices() {
    DenseIndex<4> pairs(in_.positions.size());
    std::vector<std::uint32_t> ofCorner, fileVertex;
    for (std::size_t c = 0; c < in_.cornerNormals.size(); ++c) {
      check_();
      const Vec3& n = in_.cornerNormals[c];
      const std::uint32_t original = in_.soup.cornerVertex[in_.corners[c / 3][int(c % 3)]];
      const std::uint32_t pair =
          pairs.insert({in_.triangles[c / 3][int(c % 3)], keyBits(n.x), keyBits(n.y), keyBits(n.z)});
      if (pair == fileVertex.size()) fileVertex.push_back(original);
      fileVertex[pair] = std::min(fileVertex[pair], original);
      ofCorner.push_back(pair);
    }
    const std::vector<std::uint32_t> vertexOf = fillVertices(pairs, fileVertex);
    for (std::uint32_t& v : ofCorner) v = vertexOf[v];
    return ofCorner;
  }

  std::vector<std::uint32_t> fillVertices(const DenseIndex<4>& pairs,
                                          const std::vector<std::uint32_t>& fileVertex) {
    TriMesh& mesh = out_.mesh;
    const std::vector<bool> lone = loneVertices();
    std::vector<std::uint32_t> start(fileVertices() + 1, 0);
    for (std::uint32_t v : fileVertex) ++start[v + 1];
    for (std::size_t v = 0; v < fileVertices(); ++v) start[v + 1] += start[v] + (lone[v] ? 1 : 0);
    mesh.positions.resize(start.back());
    mesh.normals.assign(start.back(), Vec3(0, 1, 0));
    out_.representative.resize(start.back());
    std::iota(out_.representative.begin(), out_.representative.end(), 0u);
    for (std::size_t v = 0; v < lone.size(); ++v)
      if (lone[v]) mesh.positions[start[v]++] = in_.positions[v], ++loneCount_;

    std::vector<std::uint32_t> vertexOf(pairs.size()), firstAt(in_.positions.size(), kNoIndex);
    std::size_t places = 0;
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
      check_();
      const auto& [place, x, y, z] = pairs.key(i);
      const std::uint32_t vertex = vertexOf[i] = start[fileVertex[i]]++;
      mesh.positions[vertex] = in_.positions[place];
      mesh.normals[vertex] = Vec3(std::bit_cast<float>(x), std::bit_cast<float>(y), std::bit_cast<float>(z));
      if (firstAt[place] == kNoIndex) firstAt[place] = vertex, ++places;
      out_.representative[vertex] = firstAt[place];
    }
    out_.creaseVertices = pairs.size() - places;
    return vertexOf;
  }

  /// [V] finite vertices of no face, when they shall stay.
  std::vector<bool> loneVertices() const {
    std::vector<bool> lone(fileVertices(), false);
    if (!in_.keepLoneVertices) return lone;
    for (std::size_t v = 0; v < lone.size(); ++v) lone[v] = isFinite(in_.positions[v]);
    for (std::uint32_t v : in_.soup.cornerVertex)
      if (v < lone.size()) lone[v] = false;
    return lone;
  }

  void triangles(const std::vector<std::uint32_t>& vertexOfCorner) {
    out_.mesh.triangles.reserve(in_.triangles.size());
    for (std::size_t c = 0; c < vertexOfCorner.size(); c += 3)
      out_.mesh.triangles.push_back({vertexOfCorner[c], vertexOfCorner[c + 1], vertexOfCorner[c + 2]});
  }

  void textureCoordinates() {
    const PolygonSoup& soup = in_.soup;
    if (soup.uv.empty() || soup.cornerUv.empty()) return;
    std::vector<std::uint32_t> newIndex(soup.uv.size(), kNoIndex);
    std::uint32_t filler = kNoIndex;
    const auto append = [&](const Vec2& uv) {
      out_.mesh.uv.push_back(uv);
      return std::uint32_t(out_.mesh.uv.size() - 1);
    };
    const auto indexOf = [&](std::uint32_t corner) {
      const std::uint32_t old = soup.cornerUv[corner];
      if (old < soup.uv.size() && std::isfinite(soup.uv[old].x) && std::isfinite(soup.uv[old].y)) {
        if (newIndex[old] == kNoIndex) newIndex[old] = append(soup.uv[old]);
        return newIndex[old];
      }
      ++out_.filledUvs;
      if (filler == kNoIndex) filler = append(Vec2(0));
      return filler;
    };
    for (const UVec3& c : in_.corners) {
      check_();
      const std::uint32_t x = indexOf(c.x), y = indexOf(c.y), z = indexOf(c.z);
      out_.mesh.uvTriangles.push_back({x, y, z});
    }
  }

  /// Vertices of the file that no triangle uses, and those that went into others.
  void countVertices() {
    std::vector<bool> isUsed(fileVertices(), false);
    for (const UVec3& corners : in_.corners)
      for (int i = 0; i < 3; ++i) isUsed[in_.soup.cornerVertex[corners[i]]] = true;
    const auto used = std::size_t(std::count(isUsed.begin(), isUsed.end(), true));
    const std::size_t copies = in_.positions.size() - fileVertices();
    const std::size_t made = out_.mesh.vertexCount() - loneCount_ - copies;
    out_.removedVertices = fileVertices() - used - loneCount_;
    out_.weldedVertices = used > made ? used - made : 0;
  }

  const AssemblyInput& in_;
  CancelCheck check_;
  Assembly out_;
  std::size_t loneCount_ = 0;
};

}  // namespace

Assembly assemble(const AssemblyInput& input, Job& job) {
  return Assembler(input, job).run();
}

}  // namespace prt
