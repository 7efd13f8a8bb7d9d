#include "support/plane_thesis/circle_trials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "support/plane_thesis/random_shapes.h"

namespace medial_vk::test {
namespace {

constexpr int kSearch = 32;   // points of an arc at which its way through a circle is looked for
constexpr int kSamples = 24;  // of the part of an arc in a circle
constexpr int kBisections = 40;
constexpr int kRefinements = 24;
constexpr std::size_t kReports = 10;
constexpr double kLeastRadius = 1e-6;
constexpr double kRounding = 1e-9;  // shares above 1 by less are not counted

double distance_between(PlanePoint a, PlanePoint b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Whether a circle lies inside, and is not so small that rounding decides.
bool is_allowed(const PlaneBoundary& boundary, const PlaneCircle& circle) {
  const NearestBoundary nearest = boundary.nearest(circle.centre);
  return nearest.is_inside && circle.radius > kLeastRadius && circle.radius <= nearest.distance * (1 - kLeastRadius);
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
  against_the_flow += other.against_the_flow;
  for (const std::string& report : other.reports) {
    if (reports.size() < kReports) reports.push_back(report);
  }
  for (std::size_t s = 0; s < kStatements; ++s) {
    counterexamples[s] += other.counterexamples[s];
    if (other.worst[s].share > worst[s].share) worst[s] = other.worst[s];
  }
}

TrialShape::TrialShape(unsigned family, std::uint64_t seed) : family_(family), seed_(seed) {
  const std::vector<PlaneRing> rings = random_shape(family, seed);
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
  boundary_ = std::move(boundary).value();
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

std::vector<double> Trial::angles() const {
  SplitMix random(seed);
  std::vector<double> angles;
  angles.reserve(samples);
  for (unsigned i = 0; i < samples; ++i) {
    angles.push_back(phase + 2 * std::numbers::pi * (i + jitter * random.symmetric() / 2) / samples);
  }
  return angles;
}

Trial TrialShape::random_trial(SplitMix& random) const {
  for (;;) {
    Trial trial;
    const AxisArc& arc = axis_.arcs[choice(random, static_cast<unsigned>(axis_.arcs.size()))];
    // A third of the points are nodes.
    const double t = choice(random, 3) == 0 ? arc.t[choice(random, 2)] : uniform(random, arc.t[0], arc.t[1]);
    const MedialPoint p = medial_point(shape_, arc, t);
    const double away = p.distance * std::exp2(uniform(random, -10, 1));
    double direction = uniform(random, 0, 2 * std::numbers::pi);
    // A third of the circles lie opposite to a spoke, so that it leaves them at once.
    if (choice(random, 3) == 0) {
      const PlanePoint& foot = p.feet[choice(random, 2)];
      direction = std::atan2(foot[1] - p.point[1], foot[0] - p.point[0]) +
                  std::exp2(uniform(random, -12, 0)) * random.symmetric();
    }
    const PlanePoint centre = {p.point[0] - away * std::cos(direction), p.point[1] - away * std::sin(direction)};
    const double distance = boundary_->nearest(centre).distance;
    // Half of the circles hold the point of the axis by a little only.
    const bool is_shallow = choice(random, 2) == 0;
    trial.circle = {centre, is_shallow ? away * (1 + std::exp2(uniform(random, -20, 0)))
                                       : distance * std::exp2(uniform(random, -6, 0))};
    if (!is_allowed(*boundary_, trial.circle)) continue;
    trial.samples = static_cast<unsigned>(std::lround(3 * std::pow(100.0 / 3, uniform(random, 0, 1))));
    // Half of them see the point of the axis in the middle between two samples.
    trial.phase = choice(random, 2) == 0 ? direction + std::numbers::pi / trial.samples
                                         : uniform(random, 0, 2 * std::numbers::pi);
    trial.jitter = choice(random, 3) == 0 ? 0.9 : 0;
    trial.seed = choice(random, 1u << 30);
    return trial;
  }
}

std::string TrialShape::describe(const Trial& trial, const MedialPoint& p) const {
  return fmt::format(
      "{} {}: circle ({:.17g}, {:.17g}) radius {:.17g}, {} samples from {:.17g} jitter {} seed {}, medial point "
      "({:.17g}, {:.17g}) with feet ({:.17g}, {:.17g}) and ({:.17g}, {:.17g})",
      family_name(family_), seed_, trial.circle.centre[0], trial.circle.centre[1], trial.circle.radius, trial.samples,
      trial.phase, trial.jitter, trial.seed, p.point[0], p.point[1], p.feet[0][0], p.feet[0][1], p.feet[1][0],
      p.feet[1][1]);
}

Shares TrialShape::check_arc(const CombedCircle& combed, const Trial& trial, const AxisArc& arc,
                             TrialCounts& counts) const {
  Shares best = {}, best_t = {};
  const std::optional<std::array<double, 2>> part = part_inside(arc, trial.circle);
  if (!part) return best;
  const auto look_at = [&](double t) {
    const MedialPoint p = medial_point(shape_, arc, t);
    if (p.distance <= 1e-9 || !combed.hull_contains(p.point)) return Shares{};
    const CombedCircle::StripShares strips = combed.strip_shares(p);
    const Shares shares = {std::ranges::min(combed.published_shares(p)), std::ranges::min(combed.corollary_shares(p)),
                           strips.with_the_flow, strips.against_the_flow};
    ++counts.points;
    if (!strips.is_combed) ++counts.not_combed;
    if (strips.against_the_flow >= 0) ++counts.against_the_flow;
    for (std::size_t s = 0; s < kStatements; ++s) {
      if (shares[s] > best[s]) {
        best[s] = shares[s];
        best_t[s] = t;
      }
      if (shares[s] > counts.worst[s].share) counts.worst[s] = {shares[s], describe(trial, p)};
      if (shares[s] <= 1 + kRounding) continue;
      ++counts.counterexamples[s];
      if (counts.reports.size() >= kReports) continue;
      counts.reports.push_back(fmt::format("statement {}, share {:.12g}: {}", s, shares[s], describe(trial, p)));
    }
    return shares;
  };
  const double step = ((*part)[1] - (*part)[0]) / kSamples;
  for (int i = 0; i <= kSamples; ++i) look_at((*part)[0] + step * i);
  for (std::size_t s = 0; s < kStatements; ++s) {
    if (best[s] <= counts.worst[s].share / 2) continue;
    double low = std::max((*part)[0], best_t[s] - step), high = std::min((*part)[1], best_t[s] + step);
    for (int i = 0; i < kRefinements; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      if (look_at(a)[s] < look_at(b)[s]) {
        low = a;
      } else {
        high = b;
      }
    }
  }
  return best;
}

Shares TrialShape::check(const Trial& trial, TrialCounts& counts) const {
  Shares shares = {};
  const PlaneCircle& circle = trial.circle;
  const Result<CircleDecision> decision = decide_medial_axis(*boundary_, circle, trial.angles());
  if (!decision) return shares;
  ++counts.circles;
  if (decision.value().decision == MedialDecision::kTrue) return shares;
  const CombedCircle combed(circle, decision.value().points);
  if (!(combed.longest_gap() < 2 * circle.radius)) return shares;  // the theorem presumes it
  ++counts.undetermined;
  const std::uint64_t before = counts.points;
  for (std::size_t i = 0; i < axis_.arcs.size(); ++i) {
    const Extent& extent = extents_[i];
    if (extent.lower[0] > circle.centre[0] + circle.radius || extent.upper[0] < circle.centre[0] - circle.radius ||
        extent.lower[1] > circle.centre[1] + circle.radius || extent.upper[1] < circle.centre[1] - circle.radius) {
      continue;
    }
    const Shares here = check_arc(combed, trial, axis_.arcs[i], counts);
    for (std::size_t s = 0; s < kStatements; ++s) shares[s] = std::max(shares[s], here[s]);
  }
  if (counts.points > before) ++counts.missing;
  return shares;
}

void TrialShape::try_circles(std::uint64_t circles, std::uint64_t steps, TrialCounts& counts) const {
  SplitMix random(~seed_);
  std::array<Trial, kStatements> worst;
  Shares most = {};
  for (std::uint64_t i = 0; i < circles; ++i) {
    const Trial trial = random_trial(random);
    const Shares shares = check(trial, counts);
    for (std::size_t s = 0; s < kStatements; ++s) {
      if (shares[s] <= most[s]) continue;
      most[s] = shares[s];
      worst[s] = trial;
    }
  }
  for (std::size_t s = 0; s < kStatements; ++s) {
    for (std::uint64_t i = 0; i < steps && most[s] > 0; ++i) {
      Trial trial = worst[s];
      const double size = std::exp2(uniform(random, -16, 0));
      for (double& x : trial.circle.centre) x += size * trial.circle.radius * random.symmetric();
      trial.circle.radius *= 1 + size * random.symmetric() / 2;
      trial.phase += size * random.symmetric();
      if (!is_allowed(*boundary_, trial.circle)) continue;
      const Shares shares = check(trial, counts);
      if (shares[s] <= most[s]) continue;
      most[s] = shares[s];
      worst[s] = trial;
    }
  }
}

}  // namespace medial_vk::test
