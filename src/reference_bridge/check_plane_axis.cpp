#include "reference_bridge/check_plane_axis.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "cpu_reference/plane.h"
#include "reference_bridge/plane_conditions.h"

namespace medial_vk {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kSamples = 4000;
constexpr std::uint64_t kSeed = 20110430;
constexpr double kDeepAngleOfPlane = 0.15;  // of points that pass by their radius
constexpr double kLeastAngleOfPlane = 1e-7;
constexpr double kInside = 1.05;  // samples pass the thresholds by 5 percent

class PlaneAxisCheck {
 public:
  PlaneAxisCheck(const PreparedShape& shape, const PlaneAxisOptions& options, const PlaneAxis& axis)
      : options_(options), axis_(axis), origin_(shape.report.lower[0], shape.report.lower[1]) {
    points_.reserve(shape.points.size());
    for (const PlanePoint& p : shape.points) points_.push_back(placed(p));
    segments_.reserve(shape.segments.size());
    for (const auto& [a, b] : shape.segments) segments_.push_back({points_[a], points_[b]});
    const ShapeReport& report = shape.report;
    double greatest = 0;
    for (const double x : {report.lower[0], report.lower[1], report.upper[0], report.upper[1]}) {
      greatest = std::max(greatest, std::fabs(x));
    }
    half_ = report.longest_side() / 2 + (options.margin > 0 ? options.margin : report.longest_side() / 2);
    middle_ = (placed(report.lower) + placed(report.upper)) / 2;
    // Coordinates of the input are rounded, and then some dozen operations on differences of them.
    rounding_ = 0x1p-53 * (8 * greatest + 64 * 2 * half_);
  }

  void run(const std::function<void(double)>& progress) {
    const std::size_t steps = axis_.nodes.size() + axis_.arcs.size() + kSamples;
    std::size_t done = 0;
    const auto step = [&] {
      if (done++ % 64 == 0) progress(static_cast<double>(done) / static_cast<double>(steps));
    };
    for (const AxisNode& node : axis_.nodes) {
      step();
      test_point(placed(node.point), node.radius);
    }
    const int parts = axis_.arcs.size() < 20000 ? 4 : 2;
    for (const AxisArc& arc : axis_.arcs) {
      step();
      for (int k = 1; k < parts; ++k) test_arc(arc, arc.t[0] + (arc.t[1] - arc.t[0]) * k / parts);
    }
    std::mt19937_64 random(kSeed);
    for (std::size_t i = 0; i < kSamples; ++i) {
      step();
      test_sample(random);
    }
  }

  CheckReport report() const {
    return {{radius_.line(), contacts_.line(), side_.line(), angle_.line(), samples_.line()}};
  }

 private:
  Vector2d placed(const PlanePoint& p) const { return Vector2d(p[0], p[1]) - origin_; }
  Vector2d in_input(const Vector2d& p) const { return p + origin_; }

  /// A point of the axis is within epsilon of an exact one, whose distance differs by no more, and so does its radius.
  double allowed() const { return 2 * axis_.epsilon + rounding_; }

  void test_point(const Vector2d& p, double radius) {
    const double distance = reference::distance_to_segments(p, segments_);
    radius_.test(std::fabs(distance - radius), allowed(), in_input(p));
    if (options_.side == PlaneSide::kBoth || distance <= allowed()) return;
    const bool is_right = reference::is_inside(p, segments_) == (options_.side == PlaneSide::kInside);
    side_.test(is_right ? 0 : distance, 0, in_input(p));
  }

  void test_arc(const AxisArc& arc, double t) {
    const Vector2d p = placed(arc.curve.point_at(t));
    const double radius = arc.curve.radius_at(t);
    test_point(p, radius);
    for (const PlaneContact& contact : arc.contacts) {
      const double distance = contact.is_point ? (p - points_[contact.index]).norm()
                                               : reference::distance_to_segment(p, segments_[contact.index][0],
                                                                                segments_[contact.index][1]);
      contacts_.test(std::fabs(distance - radius), allowed(), in_input(p));
    }
    const double least = threshold(radius, 1);
    // The angle at the end of an arc is the threshold up to rounding of some 2^-49; between the ends it is greater.
    angle_.test(least - arc.curve.object_angle_at(t), 0x1p-40, in_input(p));
  }

  /// Of the object angle of a point with this radius, which passes that of the radius by a factor.
  double threshold(double radius, double factor) const {
    const double usual = std::max(options_.object_angle, kLeastAngleOfPlane);
    const bool is_deep = options_.radius > 0 && radius >= factor * options_.radius;
    return is_deep ? std::min(usual, kDeepAngleOfPlane) : usual;
  }

  void test_sample(std::mt19937_64& random) {
    // The same numbers with every standard library: distributions differ.
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const auto own = static_cast<std::size_t>(uniform() * static_cast<double>(segments_.size()));
    const double share = uniform();
    const bool is_left =
        options_.side == PlaneSide::kInside || (options_.side == PlaneSide::kBoth && random() % 2 == 0);
    const auto& [a, b] = segments_[own];
    const Vector2d along = (b - a).normalized();
    const Vector2d left(-along[1], along[0]), normal = is_left ? left : Vector2d(-left);
    const auto ball = reference::greatest_disc(a + share * (b - a), normal, own, segments_);
    if (!ball || ball->object_angle < kInside * threshold(ball->radius, kInside)) return;
    const Vector2d off = (ball->centre - middle_).cwiseAbs();
    if (options_.side != PlaneSide::kInside && off.maxCoeff() > half_ / kInside) return;
    const double sine = std::sin(ball->object_angle);
    const double nearest = distance_of_arcs(axis_, origin_, ball->centre);
    // The centre is p + n h / (1 - c), where 1 - c is twice the square of the sine.
    samples_.test(nearest, allowed() + rounding_ / (sine * sine), in_input(ball->centre));
  }

  PlaneAxisOptions options_;
  const PlaneAxis& axis_;
  Vector2d origin_, middle_;
  double half_ = 0, rounding_ = 0;
  std::vector<Vector2d> points_;
  reference::PlaneSegments segments_;
  PlaneCondition radius_{"radius = distance of the nearest segment"};
  PlaneCondition contacts_{"both contacts are at the radius"};
  PlaneCondition side_{"points are on the side that was asked for"};
  PlaneCondition angle_{"object angle >= threshold", "rad"};
  PlaneCondition samples_{"samples of the exact axis are on the arcs"};
};

}  // namespace

CheckReport check_plane_axis(const PreparedShape& shape, const PlaneAxisOptions& options, const PlaneAxis& axis,
                             const std::function<void(double)>& progress) {
  PlaneAxisCheck check(shape, options, axis);
  check.run(progress);
  return check.report();
}

}  // namespace medial_vk
