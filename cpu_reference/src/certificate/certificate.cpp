// The certificate of every ball, from the numbers as written: centre and radius in double, spokes and angles in float.
#include "cpu_reference/certificate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <tuple>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

// A unit vector written as three floats: normalising in float loses at most 4 units of roundoff (2^-24) of its length
// (squares, sum, root, division), storing moves it by at most sqrt(3) 2^-25. Together below 5 * 2^-24.
constexpr double kFloatUnit = 5 * 0x1p-24;
// The angle between two such vectors has an error of at most both errors, half of it an error of at most one. The half
// angle, below 2, is written as a float, which adds 2^-24; its computation in float from the float vectors adds some
// units more.
constexpr double kFloatAngle = kFloatUnit + 8 * 0x1p-24;

std::string describe(std::size_t ball, const Sphere& s, const std::string& what) {
  char text[160];
  std::snprintf(text, sizeof text, "ball %zu at (%.9g, %.9g, %.9g): ", ball, s.centre.x(), s.centre.y(), s.centre.z());
  return text + what;
}

/// One condition: records the count, the worst margin and the first failure.
class Condition {
 public:
  Condition(std::string condition, std::string unit) {
    line_.condition = std::move(condition);
    line_.unit = std::move(unit);
    line_.worst = std::numeric_limits<double>::infinity();
  }

  /// `margin` is the distance to failure: a negative value (or nan) is a failure.
  void test(std::size_t ball, const Sphere& sphere, double margin) {
    ++line_.tested;
    const bool good = margin >= 0;
    if (!(margin >= line_.worst)) line_.worst = margin;
    if (good) return;
    char text[64];
    std::snprintf(text, sizeof text, "misses by %.3g %s", -margin, line_.unit.c_str());
    if (line_.failed++ == 0) line_.first_failure = describe(ball, sphere, text);
  }

  CertificateLine line() const {
    CertificateLine copy = line_;
    if (copy.tested == 0) copy.worst = 0;
    return copy;
  }

 private:
  CertificateLine line_;
};

class Checker {
 public:
  Checker(const Mesh& mesh, const Result& result, double epsilon, double object_angle, double radius)
      : tree_(mesh),
        result_(result),
        epsilon_(epsilon),
        object_angle_(object_angle),
        radius_(radius),
        inside_(mesh.unbounded ? "centre outside (winding number at most 1/2)"
                               : "centre inside (winding number at least 1/2)",
                "of 1") {}

  void ball(std::size_t i) {
    const Sphere& s = result_.spheres[i];
    const Closest nearest = tree_.closest(s.centre);
    const double distance = nearest.distance;
    finite_.test(i, s, is_finite(s) ? 0 : -1);
    inside_.test(i, s, is_inside(tree_, s.centre) ? 0 : -1);
    below_.test(i, s, distance - s.radius);
    // By the contract, rounded down by at most this.
    above_.test(i, s, s.radius - (distance - 2e-6 * tree_.longest_side()));
    grow(i, s, nearest);
    spokes(i, s, distance);
    salient(i, s, distance);
    voxel(i, s);
  }

  std::vector<CertificateLine> lines() const {
    return {finite_.line(), inside_.line(), below_.line(), above_.line(),   grows_.line(),   unit_.line(),
            tip_a_.line(),  tip_b_.line(),  angle_.line(), salient_.line(), in_grid_.line(), alone_.line()};
  }

 private:
  static bool is_finite(const Sphere& s) {
    return s.centre.allFinite() && s.spoke_a.allFinite() && s.spoke_b.allFinite() && std::isfinite(s.radius) &&
           std::isfinite(s.object_angle) && s.radius > 0;
  }

  /// Lemma 2.3: pushed away from its contact by epsilon and grown by epsilon, the ball still touches that contact; if
  /// the boundary comes closer than that, it is another part of it. The margin covers the rounding of both distances
  /// and of the pushed centre.
  void grow(std::size_t i, const Sphere& s, const Closest& nearest) {
    const Vector3d pushed = s.centre - epsilon_ * direction_to(s.centre, nearest);
    const double there = tree_.closest(pushed).distance;
    grows_.test(i, s, nearest.distance + epsilon_ - 4 * tree_.rounding() - there);
  }

  void spokes(std::size_t i, const Sphere& s, double distance) {
    const double off = std::max(std::abs(s.spoke_a.norm() - 1), std::abs(s.spoke_b.norm() - 1));
    unit_.test(i, s, kFloatUnit - off);
    // The direction moves the tip by its own error times the distance; the contact from which it was computed may be a
    // float, with three coordinates off by a few 2^-24 of the longest side.
    const double rounding = kFloatUnit * distance + 4 * tree_.rounding();
    const double contact = 8 * 0x1p-24 * tree_.longest_side();
    tip_a_.test(i, s, rounding + contact - from_nearest(s.centre, s.centre + distance * s.spoke_a, distance));
    // Lemma 2.4 holds for the distance; the radius is less by at most the allowance of above_.
    const double short_by = std::max(0.0, distance - s.radius);
    const double tip_b = tree_.closest(s.centre + s.radius * s.spoke_b).distance;
    tip_b_.test(i, s, 2 * epsilon_ + rounding + short_by - tip_b);
  }

  /// The distance from the tip to the nearest boundary point of the centre, or to any of several at equal distance.
  double from_nearest(const Vector3d& centre, const Vector3d& tip, double distance) const {
    double least = std::numeric_limits<double>::infinity();
    for (int t : tree_.gather(centre, distance + 4 * tree_.rounding())) {
      least = std::min(least, (tree_.closest_on(t, centre).point - tip).norm());
    }
    return least;
  }

  void salient(std::size_t i, const Sphere& s, double distance) {
    const double angle = half_angle(s.spoke_a, s.spoke_b);
    angle_.test(i, s, kFloatAngle - std::abs(angle - s.object_angle));
    const double by_angle = std::min(angle, s.object_angle) - (object_angle_ - kFloatAngle);
    // The threshold applies to the distance; the written radius is rounded down.
    const double by_radius = radius_ > 0 ? (distance - radius_) / radius_ : -1;
    salient_.test(i, s, std::max(by_angle, by_radius));
  }

  void voxel(std::size_t i, const Sphere& s) {
    const Vector3d at = ((s.centre - result_.grid_origin) / result_.voxel_size).array().floor();
    const bool in_grid = (at.array() >= 0).all() && (at.array() < result_.grid_size.cast<double>().array()).all();
    in_grid_.test(i, s, in_grid && at == s.voxel.cast<double>() ? 0 : -1);
    alone_.test(i, s, taken_.insert({at.x(), at.y(), at.z()}).second ? 0 : -1);
  }

  const Tree tree_;
  const Result& result_;
  const double epsilon_, object_angle_, radius_;
  std::set<std::tuple<double, double, double>> taken_;
  Condition finite_{"finite numbers, positive radius", "of 1"};
  Condition inside_;
  Condition below_{"radius <= exact distance", "length"};
  Condition above_{"radius >= exact distance - 2e-6 longest side", "length"};
  Condition grows_{"grown by epsilon it meets the boundary elsewhere (Lemma 2.3)", "length"};
  Condition unit_{"spokes are unit vectors", "length"};
  Condition tip_a_{"spoke a ends at a nearest boundary point", "length"};
  Condition tip_b_{"spoke b ends within 2 epsilon of the boundary (Lemma 2.4)", "length"};
  Condition angle_{"object angle is half the angle between the spokes", "radians"};
  Condition salient_{"object angle or radius passes its threshold", "radians or share"};
  Condition in_grid_{"voxel is in the grid and as stated", "of 1"};
  Condition alone_{"no two balls share a voxel", "of 1"};
};

}  // namespace

bool Certificate::passed() const {
  return std::all_of(lines.begin(), lines.end(), [](const CertificateLine& line) { return line.failed == 0; });
}

Certificate check(const Mesh& mesh, const Result& result, double epsilon, double object_angle, double radius) {
  Checker checker(mesh, result, epsilon, object_angle, radius);
  for (std::size_t i = 0; i < result.spheres.size(); ++i) checker.ball(i);
  return {checker.lines()};
}

}  // namespace medial_vk::reference
