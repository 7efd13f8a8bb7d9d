#include "reference_bridge/check_distances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "cpu_reference/distance.h"
#include "reference_bridge/reference_bridge.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;

reference::Motion to_motion(const Pose& pose) {
  reference::Motion motion;
  for (int i = 0; i < 3; ++i) motion.rotation.row(i) = to_eigen(pose.rotation[static_cast<std::size_t>(i)]);
  motion.shift = to_eigen(pose.shift);
  return motion;
}

double greatest_coordinate(const MeshReport& report) {
  double greatest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    greatest = std::max({greatest, std::fabs(report.lower[k]), std::fabs(report.upper[k])});
  }
  return greatest;
}

/// A condition of all poses.
class Condition {
 public:
  explicit Condition(const char* words) { line_.condition = words, line_.unit = "length"; }

  /// `excess` is the violation, and what exceeds `rounding` fails.
  void test(double excess, double rounding, std::size_t pose) {
    ++line_.tested;
    line_.worst = std::max(line_.worst, excess);
    if (excess <= rounding) return;
    if (line_.failed++ == 0)
      line_.first_failure = fmt::format("{}: pose {}, by {:.3g}", line_.condition, pose + 1, excess);
  }
  const CheckLine& line() const { return line_; }

 private:
  CheckLine line_;
};

class DistanceCheck {
 public:
  DistanceCheck(const PreparedMesh& a, const PreparedMesh& b, const DistanceOptions& options)
      : a_(to_reference(a)),
        b_(to_reference(b)),
        tree_a_(a_),
        tree_b_(b_),
        size_(greatest_coordinate(a.report) + greatest_coordinate(b.report)),
        options_(options) {}

  void test(const Pose& pose, const Distance& found, std::size_t i) {
    const reference::Motion motion = to_motion(pose);
    const double error = test_interval(motion, found.lower, found.upper, i);
    if (found.upper > 0) test_points(found, motion, error, i);
  }

  void test(const Pose& pose, const DistanceBounds& found, std::size_t i) {
    test_interval(to_motion(pose), found.lower, found.upper, i);
  }

  CheckReport report() const {
    return {{lower_.line(), upper_.line(), free_.line(), hit_.line(), points_.line(), apart_.line()}};
  }
  /// Without what is about points.
  CheckReport report_of_bounds() const { return {{lower_.line(), upper_.line(), free_.line(), hit_.line()}}; }

 private:
  /// Returns the rounding error of the distances.
  double test_interval(const reference::Motion& motion, double lower, double upper, std::size_t i) {
    const double exact = exact_distance(motion);
    // An error is 32 u S (nearest_triangles.cpp), of the balls' reaches, which are at most three times the coordinates.
    // The interval has six, and the reference fewer.
    const double error = 256 * 0x1p-53 * (4 * size_ + motion.shift.norm());
    lower_.test(lower - exact, error, i);
    if (upper == 0) {
      hit_.test(exact, error, i);
      return error;
    }
    upper_.test(exact - upper, error, i);
    if (!(lower > 0)) return error;
    double excess = exact == 0 ? lower : 0;
    // With a limit of 0, the lower end is little above 0, and tells nothing.
    if (excess > 0 && excess <= error && overlap(motion, error)) excess = 2 * error;
    free_.test(excess, error, i);
    return error;
  }

  double exact_distance(const reference::Motion& motion) const {
    const double surfaces = reference::nearest_of_meshes(a_, b_, motion).distance;
    return surfaces == 0 || (!options_.surfaces_only && reference::one_holds_the_other(a_, b_, motion)) ? 0 : surfaces;
  }

  /// Whether the solids have a common point that is not one of rounding, as in check_clearances.cpp.
  bool overlap(reference::Motion motion, double error) const {
    const Vector3d shift = motion.shift;
    for (int k = 0; k < 6; ++k) {
      motion.shift = shift + (k < 3 ? 2 : -2) * error * Vector3d::Unit(k % 3);
      if (exact_distance(motion) > 0) return false;
    }
    return true;
  }

  void test_points(const Distance& found, const reference::Motion& motion, double error, std::size_t i) {
    const Vector3d on_a = to_eigen(found.on_a), on_b = to_eigen(found.on_b);
    const Vector3d in_b = motion.rotation.transpose() * (on_b - motion.shift);
    points_.test(std::max(tree_a_.closest(on_a).distance, tree_b_.closest(in_b).distance), error, i);
    apart_.test((on_a - on_b).norm() - found.upper, error, i);
  }

  reference::Mesh a_, b_;
  reference::Tree tree_a_, tree_b_;
  double size_;
  DistanceOptions options_;
  Condition lower_{"lower end <= distance of all pairs of triangles"};
  Condition upper_{"upper end >= that distance"};
  Condition free_{"free: the solids have no common point"};
  Condition hit_{"hit: they have one"};
  Condition points_{"points lie on the surfaces"};
  Condition apart_{"points no farther apart than the upper end"};
};

}  // namespace

CheckReport check_distances(const PreparedMesh& a, const PreparedMesh& b, std::span<const Pose> poses,
                            std::span<const Distance> distances, const DistanceOptions& options,
                            const std::function<void(std::size_t)>& seen) {
  DistanceCheck check(a, b, options);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    seen(i);
    check.test(poses[i], distances[i], i);
  }
  return check.report();
}

CheckReport check_distance_bounds(const PreparedMesh& a, const PreparedMesh& b, std::span<const Pose> poses,
                                  std::span<const DistanceBounds> bounds,
                                  const std::function<void(std::size_t)>& seen) {
  DistanceCheck check(a, b, {});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    seen(i);
    check.test(poses[i], bounds[i], i);
  }
  return check.report_of_bounds();
}

}  // namespace medial_vk
