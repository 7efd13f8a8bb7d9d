#include "dismissal/carriers.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

// Dots of unit vectors and cosines are off by less than 1e-15.
constexpr double kCapSlack = 1e-12;
// The number of the nearest carriers with which each carrier is compared; those that beat others are among them.
constexpr std::size_t kMostFaceRivals = 4;

/// Collects the carriers that points of one box can touch, with their spokes.
class Collector {
 public:
  Collector(const Tree& tree, const SpokeCones& cones, const Box& box, const Closest& nearest)
      : tree_(tree), cones_(cones), box_(box), radius_(box.reach()), reach_(tree, box, nearest.triangle) {}

  void add_triangle(int t, bool trusted) {
    Carrier face = blank(3);
    face.corners = {tree_.corner(t, 0), tree_.corner(t, 1), tree_.corner(t, 2)};
    if (trusted) {
      face.vertices = cones_.corners(t);
      face.spokes = Cap::around(tree_.normal(t), kFaceAngle);
      span_by(face, tree_.normal(t), tree_.normal(t), 1);
    }
    add(face, tree_.closest_on(t, box_.centre).point);
  }

  /// Lemma I. A face is touched from a side only if part of the box lies on it.
  void add_untrusted(int t) {
    if (!cones_.has_sides(t)) {
      add_triangle(t, false);
      return;
    }
    const Vector3d& n = tree_.normal(t);
    const Vector3d foot = tree_.closest_on(t, box_.centre).point;
    const double height = n.dot(box_.centre - tree_.corner(t, 0)), reach = box_.support(n) + 8 * tree_.rounding();
    for (const double side : {1.0, -1.0}) {  // behind, in front
      if (side * height > reach) continue;
      Carrier face = of_untrusted(t, {0, 1, 2}, 3);
      face.spokes = Cap::around(side * n, kFaceAngle);
      span_by(face, side * n, side * n, 1);
      add(face, foot);
    }
    for (int k = 0; k < 3; ++k) {
      const Arc* arc = cones_.arc(t, k);
      if (arc == nullptr) continue;
      Carrier edge = of_untrusted(t, {k, (k + 1) % 3, (k + 1) % 3}, 2);
      edge.spokes = Cap::around(arc->middle, arc->angle);
      edge.arc = arc;
      add(edge, foot_on_edge(edge.corners[0], edge.corners[1]));
    }
    for (int k = 0; k < 3; ++k) {
      const Cap* cone = cones_.cone(t, k);
      if (cone == nullptr) continue;
      Carrier vertex = of_untrusted(t, {k, k, k}, 1);
      vertex.spokes = *cone;
      add(vertex, vertex.corners[0]);
    }
  }

  void add_edge(int t, int k, int other, const Cap& spokes) {
    Carrier edge = blank(2);
    const Vector3d& a = tree_.corner(t, k);
    const Vector3d& b = tree_.corner(t, (k + 1) % 3);
    edge.corners = {a, b, b};
    const auto& corners = cones_.corners(t);
    edge.vertices = {corners[k], corners[(k + 1) % 3], corners[(k + 1) % 3]};
    edge.spokes = spokes;
    if (!spokes.holds_all()) span_by(edge, tree_.normal(t), tree_.normal(other), 2);
    add(edge, foot_on_edge(a, b));
  }

  void add_vertex(int t, int k, const Cap& spokes) {
    Carrier vertex = blank(1);
    const Vector3d& v = tree_.corner(t, k);
    vertex.corners = {v, v, v};
    vertex.spokes = spokes;
    add(vertex, v);
  }

  /// Returns the carriers nearest first, without those that another one beats all over the box.
  std::vector<Carrier> take() {
    const auto nearer = [](const Carrier& a, const Carrier& b) { return a.distance < b.distance; };
    std::stable_sort(carriers_.begin(), carriers_.end(), nearer);
    const double slack = 8 * tree_.rounding();
    std::vector<Carrier> left;
    left.reserve(carriers_.size());
    for (const Carrier& a : carriers_) {
      const auto rivals = std::span(left).first(std::min(kMostFaceRivals, left.size()));
      const auto beats = [&](const Carrier& c) { return is_beaten(a, a, 0, c, box_, slack); };
      if (std::ranges::none_of(rivals, beats)) left.push_back(a);
    }
    return left;
  }

 private:
  static Carrier blank(int corner_count) {
    Carrier carrier;
    carrier.corner_count = corner_count;
    carrier.normal_count = 0;
    carrier.normal_cosine = 1;
    carrier.spokes = Cap::all();
    return carrier;
  }

  Carrier of_untrusted(int t, const std::array<int, 3>& corners, int count) const {
    Carrier carrier = blank(count);
    carrier.triangle_corners = cones_.corners(t);
    for (int i = 0; i < 3; ++i) {
      carrier.corners[i] = tree_.corner(t, corners[i]);
      carrier.vertices[i] = carrier.triangle_corners[corners[i]];
    }
    return carrier;
  }

  Vector3d foot_on_edge(const Vector3d& a, const Vector3d& b) const {
    const double share = std::clamp((b - a).dot(box_.centre - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return a + share * (b - a);
  }

  static void span_by(Carrier& carrier, const Vector3d& n, const Vector3d& m, int count) {
    carrier.normals = {n, m};
    carrier.normal_count = count;
    carrier.normal_cosine = carrier.spokes.cosine;
  }

  /// Lemmas A and C for a carrier whose nearest point is `foot`.
  void add(Carrier& carrier, const Vector3d& foot) {
    const Vector3d v = foot - box_.centre;
    carrier.distance = v.norm();
    carrier.direction = carrier.distance > 0 ? Vector3d(v / carrier.distance) : Vector3d::Zero();
    if (carrier.distance > radius_) {
      if (!reach_.touches(carrier.distance, carrier.direction)) return;
      if (!turn_towards(carrier)) return;
    }
    carriers_.push_back(carrier);
  }

  /// Lemma C: spokes are also within asin(radius / D) of g. False if no spoke remains, else the smaller cap of the two.
  bool turn_towards(Carrier& carrier) const {
    const double sine = radius_ / carrier.distance, cosine = std::sqrt(1 - sine * sine);
    if (!carrier.spokes.holds_all()) {
      const double cosine_of_sum = cosine * carrier.spokes.cosine - sine * carrier.spokes.sine;
      if (carrier.direction.dot(carrier.spokes.axis) < cosine_of_sum - kCapSlack) return false;
      if (sine >= carrier.spokes.sine) return true;
    }
    // The direction to a computed point is off by rounding() / D, and D > radius.
    carrier.spokes = Cap::around(carrier.direction, std::asin(sine) + kNormalSlack);
    return true;
  }

  const Tree& tree_;
  const SpokeCones& cones_;
  const Box& box_;
  double radius_;
  BoxReach reach_;
  std::vector<Carrier> carriers_;
};

}  // namespace

std::vector<Carrier> carriers_of(const Tree& tree, const SpokeCones& cones, const Box& box, const Closest& nearest,
                                 std::span<const Contact> contacts) {
  Collector collector(tree, cones, box, nearest);
  for (const Contact& contact : contacts) {
    const int t = contact.triangle;
    if (!contact.trusted) {
      collector.add_untrusted(t);
      continue;
    }
    collector.add_triangle(t, true);
    for (int k = 0; k < 3; ++k) {
      if (const Cap* spokes = cones.edge(t, k)) collector.add_edge(t, k, cones.neighbour(t, k), *spokes);
      if (const Cap* spokes = cones.vertex(t, k)) collector.add_vertex(t, k, *spokes);
    }
  }
  return collector.take();
}

// Let m = centre + x have feet on a and b. Their distances from m are both D(m), and at least D - g . x (convexity),
// and so is the mean of these bounds. D(m) is at most the distance to the nearest point of c, at most
// D_c - g_c . x + |x|^2 / (2 D_c) (as in Lemma A). Three computed distances: 3 rounding(). A direction has an error of
// 2 rounding() / D, which moves g . x by that much times the reach of the box.
bool is_beaten(const Carrier& a, const Carrier& b, double share, const Carrier& c, const Box& box, double slack) {
  if (c.distance <= 0) return false;
  const double distance = a.distance + share * (b.distance - a.distance) - c.distance;
  if (distance <= slack) return false;
  const Vector3d direction = a.direction + share * (b.direction - a.direction) - c.direction;
  const double turns = slack * box.reach() * (1 / a.distance + 1 / b.distance + 1 / c.distance);
  return distance - slack - turns > box.support(direction) * (1 + 1e-12) + box.half.squaredNorm() / (2 * c.distance);
}

}  // namespace medial_vk::reference
