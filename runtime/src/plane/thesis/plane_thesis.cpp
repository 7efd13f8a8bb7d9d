#include "medial_vk/plane_thesis.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "plane/sites/frame.h"
#include "plane/thesis/boundary_tree.h"
#include "plane/thesis/circle.h"
#include "plane/thesis/cover.h"

namespace medial_vk {
namespace plane {
namespace {

constexpr unsigned kLeastSamples = 6;  // fewer can miss deep points (docs/theory.md)
constexpr unsigned kMostSamples = 4096;
constexpr double kDeepAngle = 0.15;        // the object angle of points that pass by their radius (Section 2.4.2)
constexpr double kLeastDisc = 0x1p-16;     // of the longest side
constexpr double kLargestDisc = 1.0 / 50;  // of the longest side, where none is given
constexpr double kDiscRange = 16;          // the largest disc to the least one, where none is given

Error bad_option(const char* message) { return {ErrorCode::kUsage, message}; }

std::vector<Vec2> points_in_units(std::span<const PlanePoint> points, const Frame& frame) {
  std::vector<Vec2> result;
  result.reserve(points.size());
  for (const PlanePoint& p : points) result.push_back(frame.to_unit(p));
  return result;
}

/// The object angle above which a disc of the cover with so many samples misses no medial point: the gaps are below
/// 2 radius sin(pi / samples), and medial points at least 4/3 radius from the boundary.
double missed_angle(unsigned samples) {
  const double half_gap = std::numbers::pi / samples;
  const double nearest = kClearance - 1 / kOverlap;  // of the points of a square, in radii
  return (half_gap + std::asin(std::min(1.0, 2 * std::sin(half_gap) / nearest))) / 2;
}

unsigned samples_for(double object_angle) {
  unsigned samples = kLeastSamples;
  while (samples < kMostSamples && missed_angle(samples) > object_angle) ++samples;
  return samples;
}

}  // namespace
}  // namespace plane

struct PlaneBoundary::Impl {
  explicit Impl(const PreparedShape& shape)
      : frame(plane::box_of(shape.points), 0),
        longest_side(plane::box_of(shape.points).longest_side()),
        sites(plane::points_in_units(shape.points, frame), shape.segments, {}, {}),
        tree(sites) {}
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool is_inside(std::uint32_t site, plane::Vec2 x) const { return sites.side_of(site, x) == plane::Side::kLeft; }
  NearestBoundary in_input(const plane::Foot& foot, plane::Vec2 x) const {
    return {frame.to_input(foot.at),
            {foot.direction.x, foot.direction.y},
            frame.scale() * foot.distance,
            is_inside(foot.site, x)};
  }

  plane::Frame frame;
  double longest_side;
  plane::SiteSet sites;
  plane::BoundaryTree tree;
};

namespace plane {
namespace {

Result<CircleDecision> decide_in_frame(const PlaneBoundary::Impl& boundary, const PlaneCircle& circle,
                                       std::span<const double> angles) {
  const Vec2 centre = boundary.frame.to_unit(circle.centre);
  const double radius = circle.radius / boundary.frame.scale();
  const Foot foot = boundary.tree.nearest(centre);
  if (!(radius > 0 && foot.distance >= radius && boundary.is_inside(foot.site, centre))) {
    return bad_option("the circle must lie inside the shape");
  }
  const std::vector<Sample> theta = sample_circle(boundary.tree, centre, radius, angles);
  CircleDecision result;
  if (const std::vector<Finding> found = decide(theta); !found.empty()) {
    result.decision = MedialDecision::kTrue;
    result.reason = found.front().reason;
    result.found = {found.front().a, found.front().b};
  }
  result.points.reserve(theta.size());
  for (const Sample& sample : theta) {
    result.points.push_back(
        {boundary.frame.to_input(sample.at), boundary.in_input(sample.foot, sample.at), sample.opposite});
  }
  return result;
}

/// Lengths in the frame's coordinates.
struct Search {
  double object_angle, radius;
  std::vector<double> angles;
  double largest, least, epsilon;
};

Result<Search> search_for(const PlaneBoundary::Impl& boundary, const PlaneThesisOptions& options) {
  if (!(options.object_angle >= 0 && options.object_angle <= std::numbers::pi / 2)) {
    return bad_option("`object_angle` must be from 0 to pi / 2");
  }
  if (!(options.radius >= 0 && std::isfinite(options.radius))) return bad_option("`radius` must be a length, or 0");
  if (options.samples != 0 && (options.samples < kLeastSamples || options.samples > kMostSamples)) {
    return bad_option("`samples` must be from 6 to 4096, or 0");
  }
  const double side = boundary.longest_side;
  const double largest = options.largest_disc == 0 ? kLargestDisc * side : options.largest_disc;
  const double least = options.least_disc == 0 ? largest / kDiscRange : options.least_disc;
  if (!(least >= kLeastDisc * side && largest >= least && std::isfinite(largest))) {
    return bad_option("the least disc must be at least 2^-16 of the longest side, and the largest one no smaller");
  }
  if (!(options.epsilon >= 0 && std::isfinite(options.epsilon))) return bad_option("`epsilon` must be a length, or 0");
  const double scale = boundary.frame.scale();
  const double angle = options.radius > 0 ? std::min(kDeepAngle, options.object_angle) : options.object_angle;
  const unsigned samples = options.samples == 0 ? samples_for(angle) : options.samples;
  const double epsilon = options.epsilon == 0 ? 0x1p-30 * side : options.epsilon;
  return Search{options.object_angle, options.radius / scale, equal_angles(samples),
                largest / scale,      least / scale,          epsilon / scale};
}

bool is_salient(double radius, double object_angle, const Search& search) {
  if (object_angle >= search.object_angle) return true;
  return search.radius > 0 && radius >= search.radius && object_angle >= kDeepAngle;
}

struct DiscResult {
  DecisionReason reason = DecisionReason::kNone;
  std::vector<PublishedPoint> points;
};

DiscResult points_in_disc(const PlaneBoundary::Impl& boundary, const Disc& disc, const Search& search) {
  const std::vector<Sample> theta = sample_circle(boundary.tree, disc.centre, disc.radius, search.angles);
  const std::vector<Finding> found = decide(theta);
  DiscResult result;
  if (!found.empty()) result.reason = found.front().reason;
  for (const Finding& finding : found) {
    const Retraction at = retract(boundary.tree, theta, finding, search.epsilon);
    const double angle = angle_between(at.first.direction, at.second.direction) / 2;
    if (!is_salient(at.first.distance, angle, search)) continue;
    const Frame& frame = boundary.frame;
    result.points.push_back({frame.to_input(at.at),
                             frame.scale() * at.first.distance,
                             {frame.to_input(at.first.at), frame.to_input(at.second.at)},
                             angle});
  }
  return result;
}

Result<PublishedAxis> find_published(const PlaneBoundary::Impl& boundary, const PlaneThesisOptions& options,
                                     LoopWatch& watch) {
  const Result<Search> checked = search_for(boundary, options);
  if (!checked) return checked.error();
  const Search& search = checked.value();
  const Cover cover = cover_inside(boundary.sites, boundary.tree, search.largest, search.least, options.threads, watch);
  std::vector<DiscResult> results(cover.discs.size());
  constexpr std::size_t kDiscBlock = 64;
  parallel_blocks(results.size(), kDiscBlock, options.threads, [&](std::size_t begin, std::size_t end) {
    watch.check();
    for (std::size_t i = begin; i < end; ++i) results[i] = points_in_disc(boundary, cover.discs[i], search);
    watch.finish(end - begin, results.size());
  });
  PublishedAxis axis;
  axis.discs = cover.discs.size();
  axis.samples = static_cast<unsigned>(search.angles.size());
  axis.missed_angle = missed_angle(axis.samples);
  axis.missed_radius = boundary.frame.scale() * cover.missed_radius;
  for (const DiscResult& result : results) {
    axis.points.insert(axis.points.end(), result.points.begin(), result.points.end());
    switch (result.reason) {
      case DecisionReason::kNone:
        ++axis.undetermined;
        break;
      case DecisionReason::kOppositeDiffers:
        ++axis.decided[0];
        break;
      case DecisionReason::kDifferentSides:
        ++axis.decided[1];
        break;
      case DecisionReason::kPointsBetween:
        ++axis.decided[2];
        break;
    }
  }
  return axis;
}

}  // namespace
}  // namespace plane

Result<PlaneBoundary> PlaneBoundary::build(const PreparedShape& shape) {
  if (shape.segments.empty()) return Error{ErrorCode::kInvalidMesh, "the shape has no segments"};
  return catch_out_of_memory("preparing a boundary in the plane", [&]() -> Result<PlaneBoundary> {
    return PlaneBoundary(std::make_shared<const Impl>(shape));
  });
}

NearestBoundary PlaneBoundary::nearest(PlanePoint p) const {
  const plane::Vec2 x = impl_->frame.to_unit(p);
  return impl_->in_input(impl_->tree.nearest(x), x);
}

double PlaneBoundary::tolerance() const { return impl_->frame.scale() * plane::kSamePoint; }

Result<CircleDecision> decide_medial_axis(const PlaneBoundary& boundary, const PlaneCircle& circle,
                                          std::span<const double> angles) {
  if (angles.size() < 3 || std::ranges::any_of(angles, [](double a) { return !std::isfinite(a); })) {
    return plane::bad_option("at least three samples with finite angles are needed");
  }
  return catch_out_of_memory("deciding about a circle",
                             [&] { return plane::decide_in_frame(boundary.impl(), circle, angles); });
}

Result<CircleDecision> decide_medial_axis(const PlaneBoundary& boundary, const PlaneCircle& circle, unsigned samples) {
  return catch_out_of_memory("deciding about a circle",
                             [&] { return decide_medial_axis(boundary, circle, plane::equal_angles(samples)); });
}

Result<PublishedAxis> find_plane_axis_as_published(const PreparedShape& shape, const PlaneThesisOptions& options,
                                                   const ProgressCallback& progress, const std::stop_token& stop) {
  const Result<PlaneBoundary> boundary = PlaneBoundary::build(shape);
  if (!boundary) return boundary.error();
  return catch_out_of_memory("finding a medial axis", [&]() -> Result<PublishedAxis> {
    try {
      LoopWatch watch(progress, stop);
      return plane::find_published(boundary.value().impl(), options, watch);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace medial_vk
