#pragma once
// A cut while it is drawn on the surface: places that were clicked, and the shortest ways between them.
// Without Qt: what it cuts is told by edges, whoever owns it edits the document.

#include "libprt/atlas/seams.h"
#include "libprt/transport/scene.h"

#include <memory>
#include <optional>
#include <vector>

namespace prt::ui {

/// What cuts are drawn on: the surface of the scene, and what cutting along each edge costs.
struct CutSurface {
  /// `creases`: how much cuts keep to creases where they may, 0..1.
  CutSurface(std::shared_ptr<const Scene> from, float creases, Job& job);

  std::shared_ptr<const Scene> scene;
  Surface surface;
  std::vector<float> alongCreases, lengths;  ///< [E]

  std::span<const float> costs(bool followCreases) const { return followCreases ? alongCreases : lengths; }
};

class CutPath {
 public:
  explicit CutPath(std::shared_ptr<const CutSurface> on) : on_(std::move(on)) {}

  bool empty() const { return places_.empty(); }
  /// Vertices that were clicked.
  const std::vector<std::uint32_t>& places() const { return places_; }
  std::uint32_t last() const { return places_.back(); }
  /// Whether a click there would close the loop.
  bool closes(std::uint32_t vertex) const { return places_.size() > 1 && vertex == places_.front(); }

  void begin(std::uint32_t vertex);
  /// Vertices from the last place to another, both included; round the other way where it closes the loop.
  /// Empty when there is no way. What was searched before is re-used.
  std::vector<std::uint32_t> wayTo(std::uint32_t vertex, bool followCreases, Job& job);
  /// A way that was cut now.
  void add(const std::vector<std::uint32_t>& way);
  void clear();
  /// Leaves out legs that are not cut any more: somebody undid them.
  void follow(const Seams& seams);

 private:
  std::shared_ptr<const CutSurface> on_;
  std::vector<std::uint32_t> places_;
  std::vector<std::vector<std::uint32_t>> legs_;  // edges between one place and the next
  std::unique_ptr<SurfacePaths> paths_;           // from the last place
  bool pathsFollow_ = false;
};

}  // namespace prt::ui
