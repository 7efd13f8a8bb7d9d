// Which side of the boundary: of points, and of whole cells.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {

enum class Side { kInside, kOutside, kMixed };

class Sides {
 public:
  Sides(const Mesh& mesh, const Tree& tree);

  /// Side of every point of the ball, if it holds no boundary point and its side can be proved; else kMixed.
  Side of_ball(const Eigen::Vector3d& centre, double radius, const Closest& nearest) const;

  /// Winding number at least 1/2. Remembers answers: not for several threads at once.
  bool inside(const Eigen::Vector3d& p, const Closest& nearest) const;

 private:
  /// What was found at a point: the winding number there lies in [low, high], and no boundary within `empty` of it.
  struct Known {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double empty = 0, rim_gap = 0;
    double low = 0, high = 0;
  };

  Known ask(const Eigen::Vector3d& p, double empty, double tolerance) const;
  Known recall(const Eigen::Vector3d& p) const;
  double change(double way, double rim_gap) const;

  const Mesh& mesh_;
  const Tree& tree_;
  mutable std::array<Known, 128> memory_;  // of the last answers: cells are visited in an order that keeps close
  mutable std::size_t next_ = 0;
  std::unique_ptr<Tree> rim_;  // open edges as triangles without area; null if there are none
  double rim_length_ = 0;
};

}  // namespace medial_vk::reference
