// The ball that touches the boundary at a vertex: caps of rims and of the ends of curves, curves, points.
#pragma once

#include <span>
#include <vector>

#include "curvature/point_grid.h"
#include "medial_vk/curvature.h"
#include "medial_vk/vertex_curvature.h"
#include "sphere_fits/quality/nearest_ball_tree.h"
#include "vertex_curvature/surface_tips.h"
#include "vertex_curvature/tip_means.h"

namespace medial_vk {

/// What a ball that touches at a vertex says of the boundary there.
struct Touch {
  CurvatureState state = CurvatureState::kFew;  ///< kCut: a cap; kCurve; kPoint; kFew: nothing.
  PointShape at;
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero();  ///< kCurve: the direction whose curvature is not known.
  std::uint32_t ball = 0;
  double depth = 0;  ///< Of a cap: how far along it the vertex is from its border.
};

class TouchingBalls {
 public:
  /// `object_angle` as in the options. The balls and their curvatures outlive it.
  TouchingBalls(std::span<const Ball> balls, const BoundaryCurvature& curvature, double object_angle);

  /// `around`: vertices near the first one, which is p, to measure the curvature along a rim.
  Touch at(const Point& p, std::span<const Point> around) const;

 private:
  /// The end of a sheet at a ball.
  struct Rim {
    Eigen::Vector3d outward, across, along;  ///< An orthonormal frame: out of the sheet, its normal, along the rim.
    double upper = 0, lower = 0;             ///< Angles of both spokes from `outward`, towards `across`.
    const TipCurvature* tips[2] = {};        ///< Known ones near those spokes.
  };
  struct Bends {
    double value = 0, error = 0;
  };

  bool find_rim(std::uint32_t ball, Rim& rim) const;
  void find_tips(std::uint32_t ball, Rim& rim) const;
  Touch cap_of_curve(std::uint32_t ball, const Eigen::Vector3d& u, double gap) const;
  Touch cap_of_rim(std::uint32_t ball, const Eigen::Vector3d& u, double gap, std::span<const Point> around) const;
  bool ends_here(const Rim& rim, double radius, double across) const;
  Bends across_rim(const Rim& rim, double radius, double share) const;
  Bends along_rim(const Rim& rim, double radius, const Eigen::Vector3d& u) const;
  Bends bend_of_vertices(const Rim& rim, double radius, const Eigen::Vector3d& u, std::span<const Point> around,
                         Eigen::Vector3d& along) const;

  std::span<const Ball> balls_;
  const BoundaryCurvature& curvature_;
  double least_angle_;
  std::vector<std::uint32_t> numbers_;  // of the balls of the tree
  std::vector<Point> centres_;
  NearestBallTree tree_;
  PointGrid grid_;
};

}  // namespace medial_vk
