// What the checks of axes and of curves between sites in the plane share.
#pragma once

#include <Eigen/Core>

#include "check_reports/check_report.h"
#include "medial_vk/plane_axis.h"

namespace medial_vk {

/// A condition of many points.
class PlaneCondition {
 public:
  explicit PlaneCondition(const char* words, const char* unit = "length") {
    line_.condition = words, line_.unit = unit;
  }

  void test(double excess, double allowed, const Eigen::Vector2d& at);
  const CheckLine& line() const { return line_; }

 private:
  CheckLine line_;
};

/// From p, which is relative to `origin` as all lengths here, to the nodes and arcs of an axis; of a parabola an upper
/// bound.
double distance_of_arcs(const PlaneAxis& axis, const Eigen::Vector2d& origin, const Eigen::Vector2d& p);

}  // namespace medial_vk
