// The side of the boundary, for points and for whole cells.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <vector>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {

enum class Side { kInside, kOutside, kMixed };

class Sides {
 public:
  Sides(const Mesh& mesh, const Tree& tree);

  /// Side of every point of the ball, if it holds no boundary point and its side can be proved; else kMixed.
  Side of_ball(const Eigen::Vector3d& centre, double radius, const Closest& nearest) const;

  /// True if the winding number is at least 1/2. Caches results, so it is not safe for concurrent calls.
  bool inside(const Eigen::Vector3d& p, const Closest& nearest) const;

 private:
  /// A cached evaluation: the winding number at the point lies in [low, high]; within `reach` of it there is no
  /// boundary, and the winding number changes no faster than `slope`.
  struct Known {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double reach = 0, slope = 0;
    double low = 0, high = 0;
  };
  struct Edge {
    Eigen::Vector3d from, to;
    int times;  // directions along it that do not cancel
  };

  Known evaluate(const Eigen::Vector3d& p, double empty, double tolerance) const;
  Known recall(const Eigen::Vector3d& p) const;
  double slope_within(const Eigen::Vector3d& p, double way) const;

  const Mesh& mesh_;
  const Tree& tree_;
  mutable std::array<Known, 128> memory_;  // of the last evaluations; cells are visited in a spatially coherent order
  mutable std::size_t next_ = 0;
  std::vector<Edge> rim_;           // open edges
  std::unique_ptr<Tree> rim_tree_;  // of these, as triangles without area, if there are many
  double rim_length_ = 0;
};

}  // namespace medial_vk::reference
