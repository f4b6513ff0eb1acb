#include "libprt/mesh/repair.h"

#include "libprt/core/error.h"
#include "libprt/mesh/assemble.h"
#include "libprt/mesh/cancel_check.h"
#include "libprt/mesh/duplicates.h"
#include "libprt/mesh/fans.h"
#include "libprt/mesh/mesh_reader.h"
#include "libprt/mesh/normals.h"
#include "libprt/mesh/orient.h"
#include "libprt/mesh/triangulate.h"
#include "libprt/mesh/weld.h"

#include <algorithm>

namespace prt {
namespace {

constexpr double kSmallest = 1e-6, kLargest = 1e9;  // extents whose squared areas are floats
/// A mesh this many times its size away from the origin is moved: floats would lose its shape.
constexpr double kFarAway = 16;

bool finite(const DVec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

class Repair {
 public:
  Repair(const PolygonSoup& soup, const RepairOptions& options, Job& job)
      : soup_(soup), options_(options), job_(job), check_(job) {}

  RepairedMesh run() {
    report_.before = diagnose(soup_, job_);
    report_.unit = soup_.unit;
    report_.notes = soup_.notes;
    job_.begin("repair", 7, "steps");
    checkUsable();
    place();
    step();
    weld();
    step();
    cutIntoTriangles();
    step();
    dropDuplicates();
    step();
    orient();
    if (options_.splitNonManifold) split();
    step();
    const std::vector<Vec3> shading = normals();
    step();
    Assembly assembly =
        assemble({soup_, positions_, triangles_, corners_, shading, !options_.removeUnreferenced}, job_);
    step();
    return finish(std::move(assembly));
  }

 private:
  void step() {
    job_.advance(1);
    job_.checkCancelled();
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& fix) const {
    throw GeometryError(problem, soup_.source, fix);
  }

  [[noreturn]] void failEmpty() const {
    fail(std::string("has no usable face: ").append(toText(report_.before)),
         "repair or export the mesh again");
  }

  void checkUsable() const {
    if (soup_.faceCount() == 0)
      fail(soup_.positions.empty() ? "holds no mesh" : "holds points but no faces",
           "give a mesh with triangles or polygons");
    if (report_.before.triangles == 0) failEmpty();
    const DVec3 extent = report_.before.high - report_.before.low;
    const double size = std::max({extent.x, extent.y, extent.z});
    if (!(size >= kSmallest && size <= kLargest))
      fail("is " + std::to_string(size) + " units large", "scale it to between 1e-6 and 1e9 units");
  }

  /// Positions as floats, taken off their place when that lies so far out that they would lose their shape.
  void place() {
    const DVec3 low = report_.before.low, high = report_.before.high, center = 0.5 * (low + high);
    const double size = length(high - low);
    if (options_.recentre && length(center) > kFarAway * size) {
      const double unit = std::pow(10.0, std::floor(std::log10(size)));  // a round offset is easier to type
      report_.offset = glm::round(center / unit) * unit;
    }
    positions_.reserve(soup_.positions.size());
    for (const DVec3& p : soup_.positions) positions_.push_back(Vec3(p - report_.offset));
  }

  void weld() {
    vertexOf_.resize(positions_.size());
    if (options_.weld)
      vertexOf_ = weldByPosition(positions_, job_);
    else
      for (std::uint32_t v = 0; v < vertexOf_.size(); ++v) vertexOf_[v] = v;
  }

  /// Triangles of corners, without faces that no renderer could use.
  void cutIntoTriangles() {
    std::vector<DVec3> outline;
    for (std::uint32_t f = 0; f < soup_.faceCount(); ++f) {
      check_();
      const auto face = soup_.face(f);
      if (std::any_of(face.begin(), face.end(),
                      [&](std::uint32_t v) { return v >= soup_.positions.size(); })) {
        ++report_.droppedOutOfRange;
      } else if (std::any_of(face.begin(), face.end(),
                             [&](std::uint32_t v) { return !finite(soup_.positions[v]); })) {
        ++report_.droppedNonFinite;
      } else if (face.size() < 3) {
        ++report_.droppedDegenerate;
      } else if (face.size() == 3) {
        addTriangle(f, {0, 1, 2});
      } else {
        outline.clear();
        for (std::uint32_t v : face) outline.push_back(soup_.positions[v]);
        for (const auto& triangle : triangulatePolygon(outline, job_)) addTriangle(f, triangle);
        ++report_.cutPolygons;
      }
    }
    if (triangles_.empty()) failEmpty();
  }

  void addTriangle(std::uint32_t face, const std::array<std::uint32_t, 3>& corners) {
    UVec3 soupCorners, vertices;
    for (int i = 0; i < 3; ++i) {
      soupCorners[i] = soup_.faceStart[face] + corners[std::size_t(i)];
      vertices[i] = vertexOf_[soup_.cornerVertex[soupCorners[i]]];
    }
    const DVec3 a(positions_[vertices.x]), b(positions_[vertices.y]), c(positions_[vertices.z]);
    const double longest2 = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    if (!(length(cross(b - a, c - a)) > 1e-10 * longest2)) {  // nor what overflows
      ++report_.droppedDegenerate;
      return;
    }
    triangles_.push_back(vertices);
    corners_.push_back(soupCorners);
    faceOf_.push_back(face);
  }

  void dropDuplicates() {
    if (!options_.dropDuplicateFaces) return;
    const std::vector<bool> drop = duplicateTriangles(triangles_, job_);
    std::size_t kept = 0;
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      if (drop[f]) continue;
      triangles_[kept] = triangles_[f];
      corners_[kept] = corners_[f];
      faceOf_[kept] = faceOf_[f];
      ++kept;
    }
    report_.droppedDuplicates = triangles_.size() - kept;
    triangles_.resize(kept);
    corners_.resize(kept);
    faceOf_.resize(kept);
  }

  Vec3 fileNormal(std::uint32_t corner) const {
    if (soup_.cornerNormal.empty()) return Vec3(0);
    const std::uint32_t n = soup_.cornerNormal[corner];
    return n < soup_.normals.size() ? soup_.normals[n] : Vec3(0);
  }

  void orient() {
    if (options_.orientation == Orientation::keep) return;
    std::vector<float> votes;
    if (!soup_.normals.empty() && !soup_.cornerNormal.empty()) {
      votes.resize(triangles_.size());
      for (std::size_t f = 0; f < triangles_.size(); ++f) {
        const DVec3 a(positions_[triangles_[f].x]), b(positions_[triangles_[f].y]),
            c(positions_[triangles_[f].z]);
        const DVec3 sum = DVec3(fileNormal(corners_[f].x)) + DVec3(fileNormal(corners_[f].y)) +
                          DVec3(fileNormal(corners_[f].z));
        const double agreement = dot(cross(b - a, c - a), sum);
        votes[f] = agreement > 0 ? 1.0f : agreement < 0 ? -1.0f : 0.0f;
      }
    }
    const bool outward = options_.orientation == Orientation::outward;
    flipped_ = trianglesToFlip({positions_, triangles_, votes, outward}, job_);
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      if (!flipped_[f]) continue;
      std::swap(triangles_[f].y, triangles_[f].z);
      std::swap(corners_[f].y, corners_[f].z);
      ++report_.flippedTriangles;
    }
  }

  void split() {
    FanSplit fans = splitIntoFans(triangles_, positions_.size(), job_);
    report_.splitVertices = fans.source.size() - positions_.size();
    for (std::size_t v = positions_.size(); v < fans.source.size(); ++v)
      positions_.push_back(positions_[fans.source[v]]);
    triangles_ = std::move(fans.triangles);
  }

  /// A shading normal for each corner.
  std::vector<Vec3> normals() {
    std::vector<Vec3> fromFile;
    if (options_.keepNormals && !soup_.normals.empty() && !soup_.cornerNormal.empty()) {
      fromFile.reserve(3 * triangles_.size());
      for (std::size_t f = 0; f < triangles_.size(); ++f)
        for (int i = 0; i < 3; ++i) {
          const Vec3 n = fileNormal(corners_[f][i]);
          fromFile.push_back(!flipped_.empty() && flipped_[f] ? -n : n);
        }
    }
    CornerNormals result = cornerNormals({positions_, triangles_, fromFile, options_.creaseAngle}, job_);
    report_.keptNormals = result.kept;
    report_.computedNormals = 3 * triangles_.size() - result.kept;
    return std::move(result.normals);
  }

  RepairedMesh finish(Assembly assembly) {
    report_.weldedVertices = assembly.weldedVertices;
    report_.removedVertices = assembly.removedVertices;
    report_.creaseVertices = assembly.creaseVertices;
    report_.filledUvs = assembly.filledUvs;
    report_.after = diagnose(toSoup(assembly.mesh), assembly.representative, job_);
    report_.after.duplicateVertices = {};  // those are creases, and places that were parted on purpose
    RepairedMesh result;
    result.mesh = std::move(assembly.mesh);
    result.report = std::move(report_);
    if (!soup_.faceMaterial.empty()) {
      for (std::uint32_t f : faceOf_) result.triangleMaterial.push_back(soup_.faceMaterial[f]);
      result.materials = soup_.materials;
    }
    return result;
  }

  const PolygonSoup& soup_;
  const RepairOptions& options_;
  Job& job_;
  CancelCheck check_;
  RepairReport report_;
  std::vector<Vec3> positions_;          // [V], and copies made by splitting
  std::vector<std::uint32_t> vertexOf_;  // [V] the vertex that stands for each
  std::vector<UVec3> triangles_;         // [F] vertices
  std::vector<UVec3> corners_;           // [F] the soup's corners
  std::vector<std::uint32_t> faceOf_;    // [F] the soup's face
  std::vector<bool> flipped_;            // [F] against the file
};

}  // namespace

RepairedMesh repair(const PolygonSoup& soup, const RepairOptions& options, Job& job) {
  if (!(options.creaseAngle >= 0))
    throw ValueError("the crease angle is negative", "repair options", "give 0 to pi");
  return Repair(soup, options, job).run();
}

TriMesh loadMesh(const std::filesystem::path& path, const RepairOptions& options, Job& job,
                 RepairReport* report) {
  RepairedMesh repaired = repair(readMesh(path, job), options, job);
  if (report) *report = std::move(repaired.report);
  return std::move(repaired.mesh);
}

}  // namespace prt
