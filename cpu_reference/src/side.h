// Which side of the boundary: of points, and of whole cells.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {

enum class Side { kInside, kOutside, kMixed };

class Sides {
 public:
  Sides(const Mesh& mesh, const Tree& tree);

  /// Side of every point of the ball, if it holds no boundary point and its side can be proved; else kMixed.
  Side of_ball(const Eigen::Vector3d& centre, double radius, const Closest& nearest) const;

  /// Winding number at least 1/2.
  bool inside(const Eigen::Vector3d& p, const Closest& nearest) const;

 private:
  const Mesh& mesh_;
  const Tree& tree_;
  std::unique_ptr<Tree> rim_;  // open edges as triangles without area; null if there are none
  double rim_length_ = 0;
};

}  // namespace medial_vk::reference
