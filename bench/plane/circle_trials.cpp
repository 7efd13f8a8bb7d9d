#include "circle_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "support/plane_thesis/random_shapes.h"

namespace medial_vk::bench {
namespace {

using test::CombedCircle;
using test::MedialPoint;
using test::uniform;

constexpr int kSearch = 32;   // points of an arc at which its way through a circle is looked for
constexpr int kSamples = 24;  // of the part of an arc in a circle
constexpr int kBisections = 40;
constexpr int kRefinements = 24;
constexpr double kRounding = 1e-9;  // shares above 1 by less are not counted

double distance_between(PlanePoint a, PlanePoint b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

std::array<double, kStatements> shares_of(const CombedCircle& combed, const MedialPoint& p) {
  return {std::ranges::min(combed.published_shares(p)), std::ranges::min(combed.corollary_shares(p)),
          combed.strip_share(p)};
}

/// The part of an arc within a circle; none if no sample of it is inside.
std::optional<std::array<double, 2>> part_inside(const AxisArc& arc, const PlaneCircle& circle) {
  const auto parameter = [&](double i) { return arc.t[0] + (arc.t[1] - arc.t[0]) * i / kSearch; };
  const auto depth = [&](double t) { return circle.radius - distance_between(arc.curve.point_at(t), circle.centre); };
  int first = -1, last = -1, nearest = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSearch; ++i) {
    const double here = depth(parameter(i));
    if (here > 0 && first < 0) first = i;
    if (here > 0) last = i;
    if (here > most) {
      most = here;
      nearest = i;
    }
  }
  const auto border = [&](double inside, double outside) {
    for (int i = 0; i < kBisections; ++i) {
      const double middle = (inside + outside) / 2;
      (depth(middle) > 0 ? inside : outside) = middle;
    }
    return inside;
  };
  if (first >= 0) {
    return std::array{first == 0 ? arc.t[0] : border(parameter(first), parameter(first - 1)),
                      last == kSearch ? arc.t[1] : border(parameter(last), parameter(last + 1))};
  }
  // The arc may pass through a margin of the circle between two samples.
  double low = parameter(std::max(0, nearest - 1)), high = parameter(std::min(kSearch, nearest + 1));
  const std::array<double, 2> around = {low, high};
  for (int i = 0; i < kBisections; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (depth(a) < depth(b) ? low : high) = depth(a) < depth(b) ? a : b;
  }
  if (!(depth(low) > 0)) return {};
  return std::array{border(low, around[0]), border(low, around[1])};
}

}  // namespace

void TrialCounts::add(const TrialCounts& other) {
  shapes += other.shapes;
  circles += other.circles;
  undetermined += other.undetermined;
  missing += other.missing;
  points += other.points;
  not_combed += other.not_combed;
  for (std::size_t s = 0; s < kStatements; ++s) {
    counterexamples[s] += other.counterexamples[s];
    if (other.worst[s].share > worst[s].share) worst[s] = other.worst[s];
  }
}

TrialShape::TrialShape(unsigned family, std::uint64_t seed) : family_(family), seed_(seed) {
  const std::vector<PlaneRing> rings = test::random_shape(family, seed);
  Result<PreparedShape> shape = prepare_shape(rings, FillRule::kEvenOdd, 1);
  if (!shape) return;
  shape_ = std::move(shape).value();
  PlaneAxisOptions options;
  options.object_angle = 0;
  options.threads = 1;
  Result<PlaneAxis> axis = find_plane_axis(shape_, options);
  Result<PlaneBoundary> boundary = PlaneBoundary::build(shape_);
  if (!axis || !boundary || axis.value().arcs.empty()) return;
  axis_ = std::move(axis).value();
  boundary_.push_back(std::move(boundary).value());
  extents_.reserve(axis_.arcs.size());
  for (const AxisArc& arc : axis_.arcs) {
    const PlanePoint a = arc.curve.point_at(arc.t[0]), b = arc.curve.point_at(arc.t[1]);
    // A parabola leaves the box of its ends by no more than its length.
    const double margin =
        arc.curve.kind == PlaneCurve::Kind::kOfPointAndSegment ? arc.curve.length(arc.t[0], arc.t[1]) / 2 : 0;
    extents_.push_back({{std::min(a[0], b[0]) - margin, std::min(a[1], b[1]) - margin},
                        {std::max(a[0], b[0]) + margin, std::max(a[1], b[1]) + margin}});
  }
  is_usable_ = true;
}

PlaneCircle TrialShape::random_circle(SplitMix& random) const {
  for (;;) {
    PlaneCircle circle;
    const AxisArc& arc = axis_.arcs[test::choice(random, static_cast<unsigned>(axis_.arcs.size()))];
    const double t = uniform(random, arc.t[0], arc.t[1]);
    const PlanePoint on_axis = arc.curve.point_at(t);
    const double away = arc.curve.radius_at(t) * std::exp2(uniform(random, -10, 1));
    const double direction = uniform(random, 0, 2 * std::numbers::pi);
    circle.centre = {on_axis[0] + away * std::cos(direction), on_axis[1] + away * std::sin(direction)};
    const NearestBoundary nearest = boundary_.front().nearest(circle.centre);
    if (!nearest.is_inside || nearest.distance < 1e-6) continue;
    // Half of the circles hold the point of the axis by a little only.
    const bool is_shallow = test::choice(random, 2) == 0;
    circle.radius = is_shallow ? away * (1 + std::exp2(uniform(random, -12, 0)))
                               : nearest.distance * std::exp2(uniform(random, -6, 0));
    if (circle.radius <= 0.999999 * nearest.distance && circle.radius > 1e-6) return circle;
  }
}

std::string TrialShape::describe(const PlaneCircle& circle, std::size_t samples, const MedialPoint& p) const {
  return fmt::format(
      "{} {}: circle ({:.17g}, {:.17g}) radius {:.17g}, {} points of Theta, medial point ({:.17g}, {:.17g}) with feet "
      "({:.17g}, {:.17g}) and ({:.17g}, {:.17g})",
      test::family_name(family_), seed_, circle.centre[0], circle.centre[1], circle.radius, samples, p.point[0],
      p.point[1], p.feet[0][0], p.feet[0][1], p.feet[1][0], p.feet[1][1]);
}

void TrialShape::check_arc(const CombedCircle& combed, const PlaneCircle& circle, const AxisArc& arc,
                           std::size_t samples, TrialCounts& counts) const {
  const std::optional<std::array<double, 2>> part = part_inside(arc, circle);
  if (!part) return;
  const double step = ((*part)[1] - (*part)[0]) / kSamples;
  const auto shares_at = [&](double t) {
    const MedialPoint p = test::medial_point(shape_, arc, t);
    if (p.distance <= 1e-9 || !combed.hull_contains(p.point)) return std::array<double, kStatements>{};
    const std::array<double, kStatements> shares = shares_of(combed, p);
    ++counts.points;
    if (shares[kStrips] < 0) ++counts.not_combed;
    for (std::size_t s = 0; s < kStatements; ++s) {
      if (shares[s] > counts.worst[s].share) counts.worst[s] = {shares[s], describe(circle, samples, p)};
      if (shares[s] <= 1 + kRounding) continue;
      ++counts.counterexamples[s];
      fmt::print("counterexample to statement {} (share {:.12g}): {}\n", s, shares[s], describe(circle, samples, p));
    }
    return shares;
  };
  std::array<double, kStatements> best = {}, best_t = {};
  for (int i = 0; i <= kSamples; ++i) {
    const double t = (*part)[0] + step * i;
    const std::array<double, kStatements> shares = shares_at(t);
    for (std::size_t s = 0; s < kStatements; ++s) {
      if (shares[s] <= best[s]) continue;
      best[s] = shares[s];
      best_t[s] = t;
    }
  }
  for (std::size_t s = 0; s < kStatements; ++s) {
    if (best[s] <= counts.worst[s].share / 2) continue;
    double low = std::max((*part)[0], best_t[s] - step), high = std::min((*part)[1], best_t[s] + step);
    for (int i = 0; i < kRefinements; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      if (shares_at(a)[s] < shares_at(b)[s]) {
        low = a;
      } else {
        high = b;
      }
    }
  }
}

void TrialShape::try_circle(SplitMix& random, TrialCounts& counts) const {
  const PlaneCircle circle = random_circle(random);
  const auto samples = static_cast<unsigned>(3 * std::pow(100.0 / 3, uniform(random, 0, 1)) + 0.5);
  const double phase = uniform(random, 0, 2 * std::numbers::pi);
  const double jitter = test::choice(random, 3) == 0 ? 0.9 : 0;  // of the distance of neighbours
  std::vector<double> angles;
  angles.reserve(samples);
  for (unsigned i = 0; i < samples; ++i) {
    angles.push_back(phase + 2 * std::numbers::pi * (i + jitter * uniform(random, -0.5, 0.5)) / samples);
  }
  const Result<CircleDecision> decision = decide_medial_axis(boundary_.front(), circle, angles);
  if (!decision) return;
  ++counts.circles;
  if (decision.value().decision == MedialDecision::kTrue) return;
  const CombedCircle combed(circle, decision.value().points);
  if (!(combed.longest_gap() < 2 * circle.radius)) return;  // the theorem presumes it
  ++counts.undetermined;
  const std::uint64_t before = counts.points;
  for (std::size_t i = 0; i < axis_.arcs.size(); ++i) {
    const Extent& extent = extents_[i];
    if (extent.lower[0] > circle.centre[0] + circle.radius || extent.upper[0] < circle.centre[0] - circle.radius ||
        extent.lower[1] > circle.centre[1] + circle.radius || extent.upper[1] < circle.centre[1] - circle.radius) {
      continue;
    }
    check_arc(combed, circle, axis_.arcs[i], decision.value().points.size(), counts);
  }
  if (counts.points > before) ++counts.missing;
}

}  // namespace medial_vk::bench
