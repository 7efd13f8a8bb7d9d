// Which side of the boundary: of points, and of whole cells.
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

  /// Winding number at least 1/2. Remembers answers: not for several threads at once.
  bool inside(const Eigen::Vector3d& p, const Closest& nearest) const;

 private:
  /// What was found at a point: the winding number there lies in [low, high]; within `reach` of it there is no
  /// boundary, and the winding number changes no faster than `slope`.
  struct Known {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double reach = 0, slope = 0;
    double low = 0, high = 0;
  };
  struct Edge {
    Eigen::Vector3d from, to;
    int times;  // that it is run along more often one way than the other
  };

  Known ask(const Eigen::Vector3d& p, double empty, double tolerance) const;
  Known recall(const Eigen::Vector3d& p) const;
  double slope_within(const Eigen::Vector3d& p, double way) const;

  const Mesh& mesh_;
  const Tree& tree_;
  mutable std::array<Known, 128> memory_;  // of the last answers: cells are visited in an order that keeps close
  mutable std::size_t next_ = 0;
  std::vector<Edge> rim_;           // open edges
  std::unique_ptr<Tree> rim_tree_;  // of these, as triangles without area, if they are many
  double rim_length_ = 0;
};

}  // namespace medial_vk::reference
