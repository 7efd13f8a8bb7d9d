// The samples of foams: Algorithm 3 (Sections 3.1, 3.2) and the iteration of Section 3.5.
#include <algorithm>
#include <cmath>
#include <new>
#include <utility>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "base/spiral.h"
#include "medial_vk/foam.h"

namespace medial_vk {

namespace {

Result<std::vector<Point>> evaluate(const NearestPointsFunction& nearest, const std::vector<Point>& queries) {
  auto answers = nearest(queries);
  if (answers.ok() && answers.value().size() != queries.size()) {
    return Error{ErrorCode::kUsage, "foam: `nearest` returned " + std::to_string(answers.value().size()) +
                                        " points for " + std::to_string(queries.size()) + " queries"};
  }
  return answers;
}

/// The point where the line through p leaves the ball in the given unit direction; p itself if it leaves there already.
Point exit_of(const Ball& sphere, const Point& p, const Point& direction) {
  const Point from = p - sphere.centre;
  const double along = dot(from, direction);
  const double rest = along * along - dot(from, from) + sphere.radius * sphere.radius;
  const double step = std::sqrt(std::max(0.0, rest)) - along;
  return p + std::max(0.0, step) * direction;
}

/// A segment of a line through its near end's nearest boundary point, which lies on the side of the near end.
struct Segment {
  Point near_contact;
  Point far_end;
};

/// Adds the far ends as samples. A medial point lies on a segment if the ball around its far end through the near
/// end's contact is not empty: the nearest boundary point changes along it (Lemma 2.2).
Status test_segments(SphereSamples& out, const std::vector<Segment>& segments, double query_error,
                     const NearestPointsFunction& nearest) {
  std::vector<Point> queries;
  queries.reserve(segments.size());
  for (const Segment& s : segments) queries.push_back(s.far_end);
  const auto answers = evaluate(nearest, queries);
  if (!answers.ok()) return answers.error();
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const Point& far_end = segments[k].far_end;
    const double through_near = length(far_end - segments[k].near_contact);
    const double distance = length(far_end - answers.value()[k]);
    // A few units in the last place of the operands of a distance, 2^-49 each.
    const double rounding = 0x1p-46 * (through_near + length(far_end) + out.sphere.radius);
    if (through_near - distance > 2 * query_error + rounding) out.holds_medial_point = true;
    out.samples.push_back({far_end, answers.value()[k]});
  }
  return {};
}

/// The segment from a sample through the ball, away from its contact or, if that leaves the ball at once, towards it.
/// No value if the sample lies on the boundary, or the line towards the contact passes through it.
void add_segment(const Ball& sphere, const FoamSample& sample, std::vector<Segment>& segments,
                 std::vector<FoamSample>& towards) {
  const double distance = length(sample.query - sample.nearest);
  if (distance == 0) return;
  const Point away = (1 / distance) * (sample.query - sample.nearest);
  const Point far_end = exit_of(sphere, sample.query, away);
  if (length(far_end - sample.query) > 1e-9 * sphere.radius) {
    segments.push_back({sample.nearest, far_end});
    return;
  }
  const Point near_end = exit_of(sphere, sample.query, -1.0 * away);
  // All points on the line to the contact have the same contact: no query is needed.
  if (length(near_end - sample.query) < distance) towards.push_back({near_end, sample.nearest});
}

}  // namespace

Ball sphere_around_voxel(const Point& centre, double side) { return {centre, std::sqrt(0.75) * side}; }

Result<SphereSamples> sample_sphere(const Ball& sphere, const SphereSamplingOptions& sampling,
                                    const NearestPointsFunction& nearest) try {
  if (!(sphere.radius > 0)) return Error{ErrorCode::kUsage, "foam: the radius of `sphere` must be positive"};
  std::vector<Point> queries;
  for (const Point& direction : spiral_points(sampling.count))
    queries.push_back(sphere.centre + sphere.radius * direction);
  if (sampling.deep_samples) queries.push_back(sphere.centre);
  const auto answers = evaluate(nearest, queries);
  if (!answers.ok()) return answers.error();

  SphereSamples out;
  out.sphere = sphere;
  std::vector<Segment> segments;
  std::vector<FoamSample> towards;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    const FoamSample sample = {queries[k], answers.value()[k]};
    out.samples.push_back(sample);
    add_segment(sphere, sample, segments, towards);
  }
  if (sampling.deep_samples) {
    // The centre's segment ends in c_in; c_out lies in the other direction, on the line to the contact unless the
    // sphere meets it.
    const FoamSample& centre = out.samples.back();
    const double distance = length(centre.query - centre.nearest);
    if (distance > sphere.radius)
      towards.push_back({centre.query + (sphere.radius / distance) * (centre.nearest - centre.query), centre.nearest});
  }
  out.samples.insert(out.samples.end(), towards.begin(), towards.end());
  const Status tested = test_segments(out, segments, sampling.query_error, nearest);
  if (!tested.ok()) return tested.error();
  return out;
} catch (const std::bad_alloc&) {
  return out_of_memory("sampling a sphere");
}

Status refine_samples(const Foam& foam, double query_error, const NearestPointsFunction& nearest,
                      SphereSamples& samples) try {
  std::vector<Point> queries;
  for (const FoamBall& f : foam.full_balls()) {
    if (f.kind != FoamBallKind::kHullVertex) queries.push_back(f.ball.centre);
  }
  const auto answers = evaluate(nearest, queries);
  if (!answers.ok()) return answers.error();
  std::vector<Segment> segments;
  std::vector<FoamSample> towards;
  for (std::size_t k = 0; k < queries.size(); ++k) {
    const FoamSample sample = {queries[k], answers.value()[k]};
    samples.samples.push_back(sample);
    add_segment(samples.sphere, sample, segments, towards);
  }
  samples.samples.insert(samples.samples.end(), towards.begin(), towards.end());
  return test_segments(samples, segments, query_error, nearest);
} catch (const std::bad_alloc&) {
  return out_of_memory("refining the samples of a sphere");
}

}  // namespace medial_vk
