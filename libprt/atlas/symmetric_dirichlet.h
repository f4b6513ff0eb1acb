#pragma once
// Descent of the symmetric Dirichlet energy of a flat map (Smith and Schaefer 2015): the mean over the
// surface of (s1^2 + s2^2 + s1^-2 + s2^-2) / 4 with the singular values s of the map, 1 for an isometry and
// infinite for a triangle about to flip. Newton's method with the exact eigenvalues of each triangle's
// Hessian, negative ones left out (Smith, de Goes and Kim 2019); steps are cut before the first flip, and
// with a free boundary before it meets itself: the map stays injective. So that a boundary slides along
// itself rather than sticks, sides that come near each other repel (as in Smith and Schaefer 2015).

#include "libprt/atlas/flat_chart.h"
#include "libprt/atlas/sparse_cholesky.h"

#include <memory>

namespace prt {

class SymmetricDirichlet {
 public:
  /// `fixedBoundary`: boundary vertices stay where they are. Keeps a reference to the chart. Throws
  /// Cancelled.
  SymmetricDirichlet(const FlatChart& chart, bool fixedBoundary, Job& job);

  /// Infinite when a triangle is flipped.
  double energy(const std::vector<DVec2>& uv) const;
  /// One Newton step from an injective map. Returns the energy after it; equal to that before when no shorter
  /// step lowers it. Throws Cancelled and leaves uv as it was then.
  double step(std::vector<DVec2>& uv, Job& job);

 private:
  struct Rest {          ///< a triangle laid flat without distortion
    DVec2 gradients[3];  ///< of the linear functions that are 1 at a corner and 0 at the others
    double area;
  };
  struct Contact {  ///< a boundary vertex near a boundary side
    std::uint32_t vertex, from, to;
    double reach;  ///< distance from which on they repel
  };
  std::vector<Contact> contacts(const std::vector<DVec2>& uv) const;
  double repulsion(const std::vector<DVec2>& uv, const std::vector<Contact>& near) const;
  void assembleRepulsion(const std::vector<DVec2>& uv, const std::vector<Contact>& near,
                         std::vector<std::array<double, 2>>& descent);
  void assemble(const std::vector<DVec2>& uv, std::vector<std::array<double, 2>>& descent, Job& job);
  /// Eases the references of triangles that are far off: of their distortion only so much is taken on in one
  /// step that Newton's model still holds (Liu et al. 2018, "Progressive parameterizations").
  void ease(const std::vector<DVec2>& uv, Job& job);
  double meanEnergy(const std::vector<Rest>& rest, const std::vector<DVec2>& uv) const;
  double largestStep(const std::vector<DVec2>& uv, const std::vector<DVec2>& direction) const;
  bool boundaryIsSimple(const std::vector<DVec2>& uv) const;

  const FlatChart& chart_;
  bool fixedBoundary_;
  std::vector<Rest> rest_, eased_;
  bool isEased_ = false;
  double restArea_ = 0;
  std::vector<std::uint32_t> unknown_;  // [n]
  std::vector<std::uint32_t> slot_;     // [e] edge of the solver, kNowhere where an end is fixed
  std::unique_ptr<SparseCholesky<2>> solver_;
  double reach_ = 0;    // of the repulsion
  double energy_ = -1;  // of the last step's result, without repulsion
};

}  // namespace prt
