#pragma once
// The faces of a soup over welded positions: what diagnosis first finds out about each alone and then looks
// at as surfaces. Internal to mesh/.

#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/diagnose.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace prt {

struct WeldedFaces {
  const PolygonSoup& soup;
  std::vector<std::uint32_t> corners = {};  ///< [C] representative vertices
  std::vector<bool> skip = {};              ///< [F] faces without part in topology
  std::size_t solid = 0;                    ///< faces that are not skipped

  std::span<const std::uint32_t> face(std::size_t f) const {
    return std::span(corners).subspan(soup.faceStart[f], soup.faceStart[f + 1] - soup.faceStart[f]);
  }
  /// The triangles of its fan.
  template <class Visit>
  void forEachTriangle(std::size_t f, Visit visit) const {
    const auto corner = face(f);
    for (std::size_t i = 1; i + 1 < corner.size(); ++i)
      visit(soup.positions[corner[0]], soup.positions[corner[i]], soup.positions[corner[i + 1]]);
  }
  void appendTriangles(std::size_t f, std::vector<DVec3>& to) const {
    forEachTriangle(f, [&](const DVec3& a, const DVec3& b, const DVec3& c) {
      to.insert(to.end(), {a, b, c});
    });
  }
  void placePoint(Defect& defect, std::uint32_t v) const {
    defect.places.add(DefectPlaces::Points, {&soup.positions[v], 1});
  }
};

/// Components, edges, surfaces, fans and boundary loops: what faces are together. Adds to the report.
void diagnoseSurfaces(const WeldedFaces& faces, MeshReport& report, Job& job);

}  // namespace prt
