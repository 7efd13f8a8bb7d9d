#include "sphere_fits/quality/envelope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Largest coordinate or radius.
double magnitude_of(std::span<const Ball> balls) {
  double magnitude = 0;
  for (const Ball& ball : balls) {
    for (const double x : ball.centre) magnitude = std::max(magnitude, std::fabs(x) + ball.radius);
  }
  return magnitude;
}

}  // namespace

std::size_t meet(const Ball& a, const Ball& b, const Ball& c, double tolerance, std::array<Point, 2>& points) {
  // In the plane of the centres, relative to a: p.x = |x|^2 / 2 + (r_a^2 - r^2) / 2 for x = b - a and x = c - a.
  const Point ab = b.centre - a.centre, ac = c.centre - a.centre;
  const Point normal = cross(ab, ac);
  const double area2 = dot(normal, normal);
  if (area2 == 0) return 0;
  const double kb = 0.5 * (dot(ab, ab) + (a.radius - b.radius) * (a.radius + b.radius));
  const double kc = 0.5 * (dot(ac, ac) + (a.radius - c.radius) * (a.radius + c.radius));
  const Point foot = (1 / area2) * ((kb * cross(ac, normal)) + (kc * cross(normal, ab)));
  const double height2 = (a.radius - length(foot)) * (a.radius + length(foot));
  const double scale = std::max({a.radius, b.radius, c.radius, tolerance});
  if (height2 < -2 * tolerance * scale) return 0;
  if (height2 <= 0) {
    points[0] = a.centre + foot;
    return 1;
  }
  const Point up = (std::sqrt(height2) / std::sqrt(area2)) * normal;
  points[0] = a.centre + (foot + up);
  points[1] = a.centre + (foot - up);
  return 2;
}

void Envelope::find_vertices() {
  const std::vector<Ball>& balls = tree_.balls();
  tolerance_ = 1e-10 * magnitude_of(balls);
  distance_error_ = 4 * tolerance_;
  vertices_.clear();
  first_arc_.assign(balls.size() + 1, 0);
  for (const auto& edge : union_.complex.edges) ++first_arc_[edge[0] + 1];
  for (std::size_t i = 0; i < balls.size(); ++i) first_arc_[i + 1] += first_arc_[i];
  // Triangles are in the order of their balls, and so are the vertices.
  first_vertex_.assign(balls.size() + 1, 0);
  for (const auto& triangle : union_.complex.triangles) add_vertices(triangle);
  for (const EnvelopeVertex& vertex : vertices_) ++first_vertex_[vertex.balls[0] + 1];
  for (std::size_t i = 0; i < balls.size(); ++i) first_vertex_[i + 1] += first_vertex_[i];
}

void Envelope::add_vertices(const std::array<std::uint32_t, 3>& balls) {
  std::array<Point, 2> points;
  const std::vector<Ball>& all = tree_.balls();
  const std::size_t count = meet(all[balls[0]], all[balls[1]], all[balls[2]], tolerance_, points);
  for (std::size_t k = 0; k < count; ++k) {
    const EnvelopeVertex vertex = {points[k], balls};
    if (is_exposed(vertex.at)) {
      vertices_.push_back(vertex);
      continue;
    }
    // The common point itself may be exposed where its error reaches out of the balls.
    const double error = error_of(vertex);
    if (tree_.holds(vertex.at, error)) continue;
    vertices_.push_back(vertex);
    distance_error_ = std::max(distance_error_, 4 * error);
  }
}

/// docs/theory.md, "Cover", "Points of three spheres". 16 u times the lengths bound the rounding of a distance; those
/// of the formulas below are less than 2^-40 of each result, but for the direction of the normal.
double Envelope::error_of(const EnvelopeVertex& vertex) const {
  double residual = 0, greatest = 0, least = std::numeric_limits<double>::infinity();
  std::array<Point, 3> from;
  for (std::size_t k = 0; k < 3; ++k) {
    const Ball& ball = tree_.balls()[vertex.balls[k]];
    from[k] = ball.centre - vertex.at;
    residual = std::max(residual, std::fabs(length(from[k]) - ball.radius));
    greatest = std::max(greatest, ball.radius);
    least = std::min(least, ball.radius);
  }
  const double off = residual + 16 * 0x1p-53 * (greatest + length(vertex.at));
  const double anywhere = 2 * least + off;  // both points lie on the smallest sphere
  const auto centre = [&](std::size_t k) -> const Point& { return tree_.balls()[vertex.balls[k]].centre; };
  double shorter = 0;
  const Point normal = double_area(centre(0), centre(1), centre(2), shorter);
  const double rounding = kAreaRounding * shorter, area = length(normal) - rounding;
  if (!(area > 0)) return anywhere;
  const std::array lengths = {length(centre(1) - centre(0)), length(centre(2) - centre(1)),
                              length(centre(0) - centre(2))};
  const double two_sides = lengths[0] + lengths[1] + lengths[2] - std::ranges::max(lengths);
  const double squares = off * (2 * greatest + off);
  const double across = squares * two_sides / area;
  const double along = squares + across * (2 * (greatest + off) + across);
  const double turn = 2 * rounding / area + 0x1p-50;  // of the normal, and the rounding of the product
  const double height = std::fabs(dot(normal, from[0])) / length(normal) - turn * length(from[0]);
  const double up = height > 0 ? std::min(std::sqrt(along), along / height) : std::sqrt(along);
  return std::min((1 + 0x1p-40) * (across + up), anywhere);
}

Result<Envelope> Envelope::build(std::span<const Ball> balls, unsigned threads) {
  Result<BallUnion> measured = measure_ball_union(balls, {threads, true});
  if (!measured) return measured.error();
  Envelope envelope;
  envelope.tree_.rebuild(balls);
  envelope.union_ = std::move(measured).value();
  envelope.find_vertices();
  return envelope;
}

Status Envelope::rebuild(std::span<const Ball> balls, UnionMeasurer& measurer, WorkerPool& pool) {
  if (Status status = measurer.measure(balls, true, pool); !status) return status;
  tree_.rebuild(balls);
  union_ = measurer.result();
  find_vertices();
  return {};
}

void Envelope::improve_on_arc(std::uint32_t ball, std::uint32_t other, const Point& p, EnvelopePoint& best) const {
  const Ball &a = tree_.balls()[ball], &b = tree_.balls()[other];
  const Point between = b.centre - a.centre;
  const double gap = length(between);
  if (gap == 0) return;
  const Point axis = (1 / gap) * between;
  const double along = (gap * gap + (a.radius - b.radius) * (a.radius + b.radius)) / (2 * gap);
  const double squared = (a.radius - along) * (a.radius + along);
  if (squared < 0) return;
  const Point middle = a.centre + along * axis;
  const Point to = p - middle;
  const Point across = to - dot(to, axis) * axis;
  const double out = length(across);
  // On the axis all points of the circle are equally near, also the ends of the arc, if it has any: any of them is
  // valid.
  const Point away = out > 0 ? (1 / out) * across : perpendicular_to(axis);
  const Point near = middle + std::sqrt(squared) * away;
  const double distance = length(p - near);
  if (distance < best.distance && is_exposed(near)) best = {distance, near};
}

void Envelope::improve(std::uint32_t ball, const Point& p, EnvelopePoint& best) const {
  const Ball& a = tree_.balls()[ball];
  const Point to = p - a.centre;
  const double from_centre = length(to);
  const double distance = std::fabs(from_centre - a.radius);
  if (distance >= best.distance) return;  // Nothing on this sphere is nearer.
  const Point way = from_centre > 0 ? (1 / from_centre) * to : Point{0, 0, 1};
  if (const Point pole = a.centre + a.radius * way; is_exposed(pole)) {
    best = {distance, pole};
    return;
  }
  for (std::uint32_t k = first_arc_[ball]; k < first_arc_[ball + 1]; ++k) {
    improve_on_arc(ball, union_.complex.edges[k][1], p, best);
  }
  for (std::uint32_t k = first_vertex_[ball]; k < first_vertex_[ball + 1]; ++k) {
    const double from_vertex = length(p - vertices_[k].at);
    if (from_vertex < best.distance) best = {from_vertex, vertices_[k].at};
  }
}

EnvelopePoint Envelope::nearest(const Point& p, double enough) const {
  const NearestBall outside = tree_.nearest(p);
  if (outside.distance >= 0) return {outside.distance, point_of_sphere(tree_.balls()[outside.ball], p)};
  // A point of the envelope lies on a sphere; boxes of centres and radii bound the distance to it.
  struct Entry {
    std::uint32_t node;
    double bound;
  };
  const std::vector<NearestBallTree::Node>& nodes = tree_.nodes();
  const auto bound_of = [&](std::uint32_t at) {
    const NearestBallTree::Node& node = nodes[at];
    return std::max(
        {0.0, distance_to_box(node, p) - node.greatest_radius, node.least_radius - farthest_in_box(node, p)});
  };
  std::array<Entry, 64> stack;
  std::size_t size = 0;
  stack[size++] = {0, bound_of(0)};
  EnvelopePoint best = {std::numeric_limits<double>::infinity(), p};
  while (size > 0 && best.distance > enough) {
    const Entry entry = stack[--size];
    if (entry.bound >= best.distance) continue;
    const NearestBallTree::Node& node = nodes[entry.node];
    if (node.right != 0) {
      Entry near = {entry.node + 1, bound_of(entry.node + 1)}, far = {node.right, bound_of(node.right)};
      if (far.bound < near.bound) std::swap(near, far);
      if (far.bound < best.distance) stack[size++] = far;
      if (near.bound < best.distance) stack[size++] = near;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) improve(tree_.order()[k], p, best);
  }
  return best;
}

double Envelope::distance_along(const Point& p, const Point& direction, double most) const {
  constexpr int kMostBalls = 8;  // along the way; more are rarely worth it
  double along = 0;
  for (int step = 0; step < kMostBalls && along <= most; ++step) {
    const Point at = p + along * direction;
    const NearestBall inside = tree_.nearest(at);
    if (inside.distance >= -tolerance_) return along;
    const Ball& ball = tree_.balls()[inside.ball];
    const Point w = at - ball.centre;
    const double middle = -dot(w, direction);
    along += middle + std::sqrt(std::max(0.0, middle * middle + ball.radius * ball.radius - dot(w, w)));
  }
  return std::numeric_limits<double>::infinity();
}

double Envelope::signed_distance(const Point& p) const { return tree_.holds(p) ? -distance(p) : distance(p); }

}  // namespace medial_vk
