#pragma once
// One chart laid flat: bijective from the first moment, then less and less stretched. An interactive view
// makes a Flattening and calls step() in the background, showing uv() after each; flatten() does all of it.

#include "libprt/atlas/stretch.h"
#include "libprt/atlas/symmetric_dirichlet.h"
#include "libprt/atlas/tutte.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace prt {

enum class ChartBoundary {
  Free,    ///< moves with the inside, never over itself
  Polygon  ///< on straight sides between corners on a circle (bi-scale, 4.3)
};

struct FlattenOptions {
  ChartBoundary boundary = ChartBoundary::Free;
  /// Polygon: indices into the boundary, in any order; empty = `cornerCount` spread by length.
  std::vector<std::uint32_t> corners;
  int cornerCount = 8;
  int steps = 100;          ///< of Newton's method at most
  double tolerance = 1e-3;  ///< stops when a step lowers the energy by less than this part of what is over 1
  int sweeps = 2;           ///< of the L2 stretch at the end
  std::string name = "chart";  ///< for errors
};

/// A chart being laid flat. Scale: lengths of the surface (a free isometry has stretch 1), about the origin.
class Flattening {
 public:
  /// Starts from Tutte's map. `chart` is kept by reference. Throws GeometryError that names the chart when
  /// triangles cannot be kept from collapsing, Cancelled.
  Flattening(const FlatChart& chart, const FlattenOptions& options, Job& job);
  /// Starts from a map that is injective already, free boundary (ValueError when it is not).
  Flattening(const FlatChart& chart, std::vector<DVec2> start, const FlattenOptions& options, Job& job);

  /// One step towards the least distortion; false when it is reached or the steps are used up.
  bool step(Job& job);
  /// The sweeps that come last.
  void finish(Job& job);

  const std::vector<DVec2>& uv() const { return uv_; }
  /// Of the polygon: indices into the boundary, rising.
  const std::vector<std::uint32_t>& corners() const { return polygon_.corners; }
  const BoundaryPolygon& polygon() const { return polygon_; }
  StretchSum stretch() const { return stretchOf(chart_.positions, uv_, chart_.triangles); }
  double energy() const { return energy_; }

  /// Moves the boundary to other corners and restarts: the inside follows in one solve, in milliseconds, as a
  /// shift of what it was where that turns nothing over, else as Tutte's map.
  void setCorners(std::vector<std::uint32_t> corners, Job& job);

 private:
  void layBoundary(std::vector<std::uint32_t> corners, Job& job);
  void center();

  const FlatChart& chart_;
  FlattenOptions options_;
  BoundaryPolygon polygon_;
  std::vector<DVec2> boundary_;  // [b] where it was laid
  std::optional<TutteMap> tutte_;
  std::optional<SymmetricDirichlet> descent_;
  std::vector<DVec2> uv_;
  double energy_ = 0;
  int stepsDone_ = 0, smallSteps_ = 0;
};

/// Called with the map after each step.
using FlattenPreview = std::function<void(const std::vector<DVec2>&)>;

/// All of it. `start`: a guess, used when it is injective (free boundary only).
std::vector<DVec2> flatten(const FlatChart& chart, const FlattenOptions& options, Job& job,
                           const std::vector<DVec2>* start = nullptr, const FlattenPreview& preview = {});

}  // namespace prt
