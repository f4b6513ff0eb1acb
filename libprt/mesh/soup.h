#pragma once
// A polygon mesh as it stands in a file: faces of any size, anything may be wrong with it. Readers make
// it, diagnose() looks at it, repair() turns it into a TriMesh.

#include "libprt/mesh/mesh.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace prt {

/// "No such element": an index that a file left out or that does not fit.
inline constexpr std::uint32_t kNoIndex = 0xffffffffu;

/// What a file says about the material of some faces.
struct SoupMaterial {
  std::string name;
  Rgb baseColor{0.8f};  ///< linear; the default when the file gives none
  bool hasColor = false;
};

struct PolygonSoup {
  std::vector<DVec3> positions;  ///< [V] in the file's own unit and place, may be non-finite
  std::vector<Vec3> normals;     ///< as in the file, may be anything
  std::vector<Vec2> uv;          ///< v up, may be anything

  /// Corners of face f are faceStart[f] .. faceStart[f + 1] - 1; one entry more than there are faces.
  std::vector<std::uint32_t> faceStart{0};
  std::vector<std::uint32_t> cornerVertex;  ///< [C] into positions; >= V when out of range
  std::vector<std::uint32_t> cornerNormal;  ///< [C] into normals or kNoIndex; empty when there are none
  std::vector<std::uint32_t> cornerUv;      ///< [C] into uv or kNoIndex; empty when there are none

  std::vector<std::uint32_t> faceMaterial;  ///< [F] into materials or kNoIndex; empty when there are none
  std::vector<SoupMaterial> materials;
  std::vector<std::uint32_t> faceGroup;  ///< [F] into groups or kNoIndex; empty when there are none
  std::vector<std::string> groups;

  std::string source;              ///< file name, for messages
  std::string unit;                ///< what the format says about lengths ("metres"), empty when it is silent
  std::vector<std::string> notes;  ///< what the reader left out or took to mean something, one line each

  std::size_t faceCount() const { return faceStart.size() - 1; }
  std::size_t cornerCount() const { return cornerVertex.size(); }
  std::span<const std::uint32_t> face(std::size_t f) const {
    return std::span(cornerVertex).subspan(faceStart[f], faceStart[f + 1] - faceStart[f]);
  }
  /// Ends a face at the corners pushed so far.
  void endFace() { faceStart.push_back(std::uint32_t(cornerVertex.size())); }
};

/// A triangle mesh as a soup, normals and UVs included.
PolygonSoup toSoup(const TriMesh& mesh);

}  // namespace prt
