// Means of shape operators of tips near a point of the boundary.
#pragma once

#include <span>
#include <vector>

#include "curvature/point_grid.h"
#include "vertex_curvature/surface_tips.h"

namespace medial_vk {

/// The boundary at a point, as a shape operator.
struct PointShape {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Matrix3d shape = Eigen::Matrix3d::Zero();
  double error = 0;
};

struct TipMean {
  bool is_found = false;
  bool is_outside = false;  ///< More than half a turn around the point has no tip: the values are extrapolated.
  bool is_cut = false;      ///< More than a third of a turn has none in the outer half of the window.
  PointShape at;
  std::uint32_t heaviest = 0;  ///< The tip that weighs most.
};

/// Shape operators vary smoothly along a sheet, while tips can lie far apart along the boundary near its rim. So
/// windows are balls of centres, around the one whose ball touches at the point.
class TipMeans {
 public:
  explicit TipMeans(const SurfaceTips& tips, double spacing);

  /// At a point of the mesh with this normal: from tips that `walk`, which began there, meets.
  TipMean at(const Point& p, const Point& normal, SurfaceWalk& walk) const;

 private:
  struct Member {
    std::uint32_t tip;
    double weight = 0;
    double x = 0, y = 0;  ///< Of the centre across the normal, in units of the window's radius.
  };
  class PlaneFit;

  bool find_nearest(const Point& p, const Point& normal, SurfaceWalk& walk, std::uint32_t& nearest) const;
  /// Tips on the same side of the sheet as `nearest`, with centres within the window around `middle`.
  std::vector<Member> members(std::uint32_t nearest, const Point& middle) const;
  void weigh(std::vector<Member>& members, const Point& middle) const;
  void place(std::vector<Member>& members, const Eigen::Matrix<double, 3, 2>& tangents, const Point& middle) const;
  Point touching_centre(std::vector<Member>& members, const Point& middle, const Point& p,
                        const Eigen::Matrix<double, 3, 2>& tangents) const;
  void mean(std::vector<Member>& members, const Point& middle, TipMean& out) const;

  const SurfaceTips& surface_;
  double radius_;  // of windows
  std::vector<Point> centres_;
  PointGrid grid_;
};

/// Two perpendicular unit vectors perpendicular to a unit vector, as columns.
Eigen::Matrix<double, 3, 2> tangents_of(const Eigen::Vector3d& normal);

/// The least rotation that takes one unit vector to another one, which is not its opposite.
Eigen::Matrix3d least_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace medial_vk
