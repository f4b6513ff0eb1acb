#pragma once
// Cuts over a surface: a set of edges, as a value; shortest paths between clicked vertices; chains of a cut.

#include "libprt/atlas/surface.h"

#include <span>
#include <string>
#include <vector>

namespace prt {

/// Edges of a surface that are cut. Borders are cut by nature and need no mark.
class Seams {
 public:
  Seams() = default;
  explicit Seams(const Surface& surface) : Seams(surface.edgeCount()) {}
  explicit Seams(std::size_t edges) : marks_(edges, 0) {}

  bool operator[](std::uint32_t edge) const { return marks_[edge] != 0; }
  void set(std::uint32_t edge, bool cut = true) { marks_[edge] = cut; }
  std::size_t size() const { return marks_.size(); }  ///< edges of the surface
  std::size_t count() const;                          ///< edges that are cut
  std::vector<std::uint32_t> edges() const;           ///< those that are cut, in rising order
  bool operator==(const Seams&) const = default;

 private:
  std::vector<std::uint8_t> marks_;
};

/// Cuts along neighbouring vertices (or mends: `cut` false). Throws ValueError when two of them are not
/// joined by an edge.
void cutPath(const Surface& surface, std::span<const std::uint32_t> vertices, Seams& seams, bool cut = true);

/// Edges of the cut from `edge` both ways up to where it ends or forks, or round a loop; empty when `edge`
/// is not cut. What one erasing click takes.
std::vector<std::uint32_t> seamChain(const Surface& surface, const Seams& seams, std::uint32_t edge);

/// Length of the cut between triangles: each edge once, borders left out.
double seamLength(const Surface& surface, const Seams& seams);

/// Seams as text for recipes: chains of vertex numbers of the mesh, "4 8 15;16 23 42". Exactly the same seams
/// give the same text.
std::string seamsToText(const Surface& surface, const Seams& seams);
/// The reverse. Throws ValueError, which names the vertices, when the text is not of that form or names an
/// edge that the mesh does not have.
Seams seamsFromText(const Surface& surface, const std::string& text);

/// Shortest paths over edges from one vertex or a set of them (Dijkstra 1959), found as far as asked: a hover
/// near the last click costs little, and moving on re-uses what was found. Ties go to the lower vertex.
class SurfacePaths {
 public:
  /// Keeps references to surface and costs ([E], not negative). Throws ValueError when their sizes differ.
  SurfacePaths(const Surface& surface, std::span<const float> costs);

  /// Starts anew.
  void startFrom(std::span<const std::uint32_t> sources);
  void startFrom(std::uint32_t source) { startFrom(std::span(&source, 1)); }
  /// Searches until `target` is reached. False when it cannot be. Throws Cancelled.
  bool reach(std::uint32_t target, Job& job);
  /// Searches everything that can be reached.
  void reachAll(Job& job);
  /// Vertices from a source to `target`, both included; empty when there is no way.
  std::vector<std::uint32_t> pathTo(std::uint32_t target, Job& job);
  /// Cost of the way to a vertex that was reached; infinite else.
  double distance(std::uint32_t vertex) const;
  /// The edge by which a reached vertex was reached; kNowhere at sources.
  std::uint32_t edgeTowardsSource(std::uint32_t vertex) const { return edgeTo_[vertex]; }

 private:
  struct Entry {
    double cost;
    std::uint32_t vertex;
    bool operator<(const Entry& other) const {  // std heaps keep the largest in front
      return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
  };
  std::uint32_t settleNext();

  const Surface& surface_;
  std::span<const float> costs_;
  std::vector<double> cost_;
  std::vector<std::uint32_t> edgeTo_;
  std::vector<std::uint8_t> settled_;
  std::vector<Entry> heap_;
};

}  // namespace prt
