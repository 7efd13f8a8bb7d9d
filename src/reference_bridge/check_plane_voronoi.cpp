#include "reference_bridge/check_plane_voronoi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "cpu_reference/plane.h"
#include "reference_bridge/plane_conditions.h"

namespace medial_vk {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kChordsOfPlane = 1500;
constexpr std::uint64_t kSeedOfPlane = 20110434;
constexpr int kHalvings = 60;
constexpr double kLeastSine = 1e-3;  // of samples: twice the least object angle of curves, and more
constexpr int kTestsOfALink = 8;

Vector2d nearest_of_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const double length = (b - a).squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0;
  return a + share * (b - a);
}

/// The nearest site at a place.
struct NearestSite {
  std::uint32_t site = 0;
  double distance = std::numeric_limits<double>::infinity();
  Vector2d contact = Vector2d::Zero();
};

class PlaneVoronoiCheck {
 public:
  PlaneVoronoiCheck(const PlaneSites& sites, const PlaneAxis& curves) : sites_(sites), curves_(curves) {
    Vector2d lower = Vector2d::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
    for (const PlanePoint& p : sites.points) {
      lower = lower.cwiseMin(Vector2d(p.data()));
      upper = upper.cwiseMax(Vector2d(p.data()));
    }
    origin_ = lower;
    size_ = upper - lower;
    double reach = size_.maxCoeff();
    for (const AxisNode& node : curves.nodes) reach = std::max(reach, placed(node.point).cwiseAbs().maxCoeff());
    // Coordinates of the input are rounded, and then some dozen operations on differences of them.
    const double greatest = std::max(lower.cwiseAbs().maxCoeff(), upper.cwiseAbs().maxCoeff());
    rounding_ = 0x1p-53 * (8 * greatest + 64 * 2 * reach);
    segments_.reserve(sites.segments.size());
    for (const auto& [a, b] : sites.segments) segments_.push_back({placed(sites.points[a]), placed(sites.points[b])});
  }

  void run(const PlaneRoadmap* roadmap, const PlanePath* path, const std::function<void(double)>& progress) {
    const std::size_t links = roadmap != nullptr ? roadmap->links().size() : 0;
    const std::size_t steps = curves_.nodes.size() + curves_.arcs.size() + kChordsOfPlane + links;
    std::size_t done = 0;
    const auto step = [&] {
      if (done++ % 64 == 0) progress(static_cast<double>(done) / static_cast<double>(steps));
    };
    for (const AxisNode& node : curves_.nodes) {
      step();
      test_radius(placed(node.point), node.radius);
    }
    for (const AxisArc& arc : curves_.arcs) {
      step();
      for (const int k : {1, 2, 3}) test_arc(arc, arc.t[0] + (arc.t[1] - arc.t[0]) * k / 4);
    }
    std::mt19937_64 random(kSeedOfPlane);
    for (std::size_t i = 0; i < kChordsOfPlane; ++i) {
      step();
      test_chord(random);
    }
    for (std::size_t i = 0; i < links; ++i) {
      step();
      test_link(roadmap->links()[i]);
    }
    if (path != nullptr) test_path(*path);
  }

  CheckReport report(bool has_roadmap) const {
    CheckReport report = {{radius_.line(), contacts_.line(), different_.line(), samples_.line()}};
    if (has_roadmap) report.lines.push_back(widths_.line());
    return report;
  }

 private:
  Vector2d placed(const PlanePoint& p) const { return Vector2d(p.data()) - origin_; }
  Vector2d in_input(const Vector2d& p) const { return p + origin_; }
  double allowed() const { return 2 * curves_.epsilon + rounding_; }

  void test_radius(const Vector2d& p, double radius) {
    radius_.test(std::fabs(reference::distance_to_segments(p, segments_) - radius), allowed(), in_input(p));
  }

  std::uint32_t site_of(const PlaneContact& contact) const {
    return (contact.is_point ? sites_.site_of_point : sites_.site_of_segment)[contact.index];
  }

  void test_arc(const AxisArc& arc, double t) {
    const Vector2d p = placed(arc.curve.point_at(t));
    const double radius = arc.curve.radius_at(t);
    test_radius(p, radius);
    for (const PlaneContact& contact : arc.contacts) {
      const double distance = contact.is_point ? (p - placed(sites_.points[contact.index])).norm()
                                               : reference::distance_to_segment(p, segments_[contact.index][0],
                                                                                segments_[contact.index][1]);
      contacts_.test(std::fabs(distance - radius), allowed(), in_input(p));
    }
    different_.test(site_of(arc.contacts[0]) == site_of(arc.contacts[1]) ? 1 : 0, 0, in_input(p));
  }

  /// Of all sites, or of all but one.
  NearestSite nearest(const Vector2d& p, std::uint32_t but) const {
    NearestSite best;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      if (sites_.site_of_segment[i] == but) continue;
      const Vector2d at = nearest_of_segment(p, segments_[i][0], segments_[i][1]);
      const double distance = (p - at).norm();
      if (distance < best.distance) best = {sites_.site_of_segment[i], distance, at};
    }
    return best;
  }

  /// Between two places with different nearest sites there is a point that is as near to the first one's as to another.
  void test_chord(std::mt19937_64& random) {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    // The same numbers with every standard library: distributions differ.
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const auto place = [&] {
      const double x = uniform(), y = uniform();
      return Vector2d((1.2 * x - 0.1) * size_[0], (1.2 * y - 0.1) * size_[1]);
    };
    Vector2d from = place(), to = place();
    const std::uint32_t own = nearest(from, kNone).site;
    if (nearest(to, kNone).site == own) return;
    for (int i = 0; i < kHalvings; ++i) {
      const Vector2d middle = 0.5 * (from + to);
      (nearest(middle, kNone).site == own ? from : to) = middle;
    }
    const NearestSite first = nearest(from, kNone), second = nearest(from, first.site);
    const Vector2d a = (first.contact - from).normalized(), b = (second.contact - from).normalized();
    const double sine = 0.5 * (a - b).norm();
    if (!(sine > kLeastSine)) return;
    // The difference of both distances, which is known up to rounding, has a gradient of twice the sine.
    samples_.test(distance_of_arcs(curves_, origin_, from), allowed() + rounding_ / sine, in_input(from));
  }

  void test_width(const Vector2d& p, double width) {
    widths_.test(width - reference::distance_to_segments(p, segments_), rounding_, in_input(p));
  }

  void test_link(const PlaneRoadmapLink& link) {
    const AxisArc& arc = curves_.arcs[link.arc];
    for (int k = 0; k <= kTestsOfALink; ++k) {
      const double t = arc.t[0] + (arc.t[1] - arc.t[0]) * k / kTestsOfALink;
      test_width(placed(arc.curve.point_at(t)), link.width);
    }
  }

  void test_path(const PlanePath& path) {
    for (std::size_t i = 1; i < path.line.size(); ++i) {
      const Vector2d from = placed(path.line[i - 1]), to = placed(path.line[i]);
      for (int k = 0; k <= kTestsOfALink; ++k) test_width(from + (to - from) * k / kTestsOfALink, path.width);
    }
  }

  const PlaneSites& sites_;
  const PlaneAxis& curves_;
  Vector2d origin_, size_;
  double rounding_ = 0;
  reference::PlaneSegments segments_;
  PlaneCondition radius_{"radius = distance of the nearest site"};
  PlaneCondition contacts_{"both contacts are at the radius"};
  PlaneCondition different_{"contacts belong to different sites", ""};
  PlaneCondition samples_{"samples of the exact curves are on the arcs"};
  PlaneCondition widths_{"no site is nearer to a link or the path than its width"};
};

}  // namespace

CheckReport check_plane_voronoi(const PlaneSites& sites, const PlaneAxis& curves, const PlaneRoadmap* roadmap,
                                const PlanePath* path, const std::function<void(double)>& progress) {
  PlaneVoronoiCheck check(sites, curves);
  check.run(roadmap, path, progress);
  return check.report(roadmap != nullptr);
}

}  // namespace medial_vk
