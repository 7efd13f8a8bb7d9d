// The mean of shape operators of tips near a point of the boundary.
#pragma once

#include <span>
#include <vector>

#include "vertex_curvature/surface_tips.h"

namespace medial_vk {

/// The boundary at a point, as a shape operator.
struct PointShape {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();
  double error = 0;
};

struct TipAverage {
  bool is_found = false;
  bool is_outside = false;  ///< More than half a turn around the point has no tip: the values are extrapolated.
  bool is_cut = false;      ///< More than a third of a turn has none in the outer half of the window.
  PointShape at;
  std::uint32_t heaviest = 0;  ///< The tip that weighs most.
};

/// `tips` are numbers in `all`. Those farther than `radius` from `p`, and those whose normals differ by more than 66
/// degrees from `normal`, do not count.
TipAverage average_tips(std::span<const SurfaceTip> all, std::span<const std::uint32_t> tips, const Point& p,
                        const Point& normal, double radius);

/// Two perpendicular unit vectors perpendicular to a unit vector, as columns.
Eigen::Matrix<double, 3, 2> tangents_of(const Eigen::Vector3d& normal);

/// The least rotation that takes one unit vector to another one, which is not its opposite.
Eigen::Matrix3d least_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace medial_vk
