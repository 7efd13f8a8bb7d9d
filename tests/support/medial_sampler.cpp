#include "support/medial_sampler.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <thread>

namespace medial_vk::test {

using Eigen::Vector3d;
using reference::Closest;
using reference::Feature;
using reference::Tree;

namespace {

constexpr int kMostShrinks = 100;
constexpr int kMostTies = 20;
constexpr int kMostNewtonSteps = 20;
constexpr int kMostClimbs = 1000;
constexpr std::size_t kMostContacts = 64;

/// SplitMix64 (Steele, Lea and Flood 2014): any seed will do, so that every sample can have a generator of its own.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index) : state_(seed * 0x9e3779b97f4a7c15u) { state_ = next() ^ index; }

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// A number in [0, 1).
  double unit() { return std::ldexp(static_cast<double>(next() >> 11), -53); }

 private:
  std::uint64_t state_;
};

/// Outside, seven of eight points are in the box of the mesh, where all spokes begin but those that leave it at once:
/// elsewhere most points lie on no way to a medial sphere in the box of the search.
Vector3d random_point(const Tree& tree, const Eigen::AlignedBox3d& box_of_mesh, Random& random) {
  const double x = random.unit(), y = random.unit(), z = random.unit();
  const bool is_near = tree.far_number() > 0 && random.next() % 8 != 0;
  const Vector3d lower = is_near ? box_of_mesh.min() : tree.lower(), upper = is_near ? box_of_mesh.max() : tree.upper();
  return lower + Vector3d(x, y, z).cwiseProduct(upper - lower);
}

/// True for points whose medial sphere counts: on the side of the tree, in its box. Balls inside a bounded solid have
/// their centres there.
bool counts(const Tree& tree, const Vector3d& centre) {
  const bool in_box = (centre.array() >= tree.lower().array()).all() && (centre.array() <= tree.upper().array()).all();
  return in_box && reference::is_inside(tree, centre);
}

/// True in front of the nearest face, which is outside of a closed mesh. Other points are tested again in the end.
bool surely_outside(const Tree& tree, const Vector3d& p, const Closest& nearest) {
  return nearest.feature == Feature::kFace && (p - nearest.point).dot(tree.normal(nearest.triangle)) > 0;
}

}  // namespace

struct MedialSampler::Contact {
  int triangle;
  Vector3d spoke;  ///< Of length 1, from the centre.
};

/// A ball that touches `count` triangles, whose spokes are known.
struct MedialSampler::Ball {
  Vector3d centre;
  double radius = 0;
  std::array<int, 4> triangles = {-1, -1, -1, -1};
  std::array<Vector3d, 4> spokes;
  int count = 0;
};

MedialSampler::MedialSampler(const Tree& tree, double least_angle, std::uint64_t seed, bool past_corners)
    : tree_(tree),
      least_angle_(least_angle),
      tolerance_(64 * tree.rounding()),
      seed_(seed),
      past_corners_(past_corners) {
  for (int t = 0; t < tree.triangle_count(); ++t) {
    for (int k = 0; k < 3; ++k) box_of_mesh_.extend(tree.corner(t, k));
  }
}

std::optional<MedialSample> MedialSampler::sample(std::uint64_t index) const {
  Random random(seed_, index);
  const Vector3d p = random_point(tree_, box_of_mesh_, random);
  const Closest nearest = tree_.closest(p);
  // Close to the boundary the direction away from it is inaccurate.
  if (nearest.distance < 1e-6 * tree_.longest_side() || surely_outside(tree_, p, nearest)) return std::nullopt;
  std::optional<Ball> ball = largest_at(nearest, (p - nearest.point) / nearest.distance);
  if (past_corners_) return on_the_way_up(ball, random.next());
  // One of four climbs although it is salient, so that seams and corners of the medial surface are sampled as well.
  std::uint64_t climbs = random.next() % 8;
  climbs = climbs < 2 ? climbs + 1 : 0;
  for (; ball; ball = climb(*ball)) {
    const double angle = object_angle(*ball);
    if (climbs > 0 && ball->count < 4) {
      --climbs;
    } else if (angle >= least_angle_) {
      if (!counts(tree_, ball->centre)) return std::nullopt;
      return MedialSample{ball->centre, ball->radius, angle};
    }
  }
  return std::nullopt;
}

// Any of the salient balls met along the whole way.
std::optional<MedialSample> MedialSampler::on_the_way_up(std::optional<Ball> ball, std::uint64_t which) const {
  std::vector<MedialSample> salient;
  for (int climbs = 0; ball && climbs < kMostClimbs; ++climbs) {
    const double angle = object_angle(*ball);
    if (angle >= least_angle_) salient.push_back({ball->centre, ball->radius, angle});
    ball = ball->count < 4 ? climb(*ball) : climb_from_corner(*ball);
  }
  if (salient.empty()) return std::nullopt;
  const MedialSample& sample = salient[which % salient.size()];
  return counts(tree_, sample.centre) ? std::optional(sample) : std::nullopt;
}

std::optional<MedialSampler::Ball> MedialSampler::largest_at(const Closest& contact, const Vector3d& away) const {
  Ball ball;
  // Outside, a ball with its centre in the box may be as large as the diagonal of the box, below 1.74 longest sides.
  ball.radius = (tree_.far_number() > 0 ? 2 : 1) * tree_.longest_side();
  ball.triangles[0] = contact.triangle;
  ball.spokes[0] = -away;
  for (int step = 0; step < kMostShrinks; ++step) {
    ball.centre = contact.point + ball.radius * away;
    const Closest inner = tree_.closest(ball.centre);
    if (inner.distance >= ball.radius - tolerance_) {
      if (ball.triangles[1] < 0) return std::nullopt;  // the solid has no end in this direction: outside
      ball.count = 2;
      ball.spokes[1] = (tree_.closest_on(ball.triangles[1], ball.centre).point - ball.centre).normalized();
      return ball;
    }
    const Vector3d chord = inner.point - contact.point;
    const double rise = away.dot(chord);
    if (rise <= 0) return std::nullopt;  // rounding: A itself
    ball.radius = std::min(ball.radius, chord.squaredNorm() / (2 * rise));
    ball.triangles[1] = inner.triangle;
  }
  return std::nullopt;
}

// Up: the direction in which the distance to the contacts grows fastest while they tie.
std::optional<MedialSampler::Ball> MedialSampler::climb(const Ball& from) const {
  if (from.count >= 4) return std::nullopt;
  Vector3d up = -(from.spokes[0] + from.spokes[1]);
  if (from.count == 3) {
    up = (from.spokes[1] - from.spokes[0]).cross(from.spokes[2] - from.spokes[0]);
    if (up.dot(from.spokes[0]) > 0) up = -up;
  }
  const double length = up.norm();
  if (length < 1e-6) return std::nullopt;  // opposite spokes, or three that tie along a line: no way up
  up /= length;
  if (from.spokes[0].dot(up) > -1e-6) return std::nullopt;
  // From far away inwards: each triangle that reaches into the ball bounds the way, as in largest_at().
  int last = -1;
  Vector3d at = from.centre + tree_.longest_side() * up;
  for (int step = 0; step < kMostTies; ++step) {
    const Closest nearest = tree_.closest(at);
    if (nearest.triangle == last) return std::nullopt;
    last = nearest.triangle;
    std::optional<Ball> ball = tie_with(from, up, nearest.triangle);
    if (!ball) return std::nullopt;
    if (tree_.closest(ball->centre).distance >= ball->radius - tolerance_) return ball;
    at = ball->centre;
  }
  return std::nullopt;
}

// Climbs along the steepest of the seams that leave the corner: a triple of contacts that tie has such a seam if no
// other contact becomes the nearest along it. None remains where the distance has a maximum.
std::optional<MedialSampler::Ball> MedialSampler::climb_from_corner(const Ball& corner) const {
  const std::vector<Contact> ties = contacts(corner);
  Ball seam = corner;
  seam.count = 3;
  double steepest = 1e-6;
  for (std::size_t i = 0; i < ties.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Vector3d& spoke = ties[i].spoke;
        Vector3d up = (ties[j].spoke - spoke).cross(ties[k].spoke - spoke);
        if (up.norm() < 1e-6) continue;
        up *= (up.dot(spoke) > 0 ? -1 : 1) / up.norm();
        const double rise = -up.dot(spoke);
        const auto recedes = [&](const Contact& c) { return -up.dot(c.spoke) > rise - 1e-9; };
        if (rise <= steepest || !std::all_of(ties.begin(), ties.end(), recedes)) continue;
        steepest = rise;
        seam.triangles = {ties[i].triangle, ties[j].triangle, ties[k].triangle, -1};
        seam.spokes = {ties[i].spoke, ties[j].spoke, ties[k].spoke, Vector3d::Zero()};
      }
    }
  }
  return steepest > 1e-6 ? climb(seam) : std::nullopt;
}

// Unknown: centre x and radius r. One equation dist(x, t) = r for each contact, whose gradient in x is minus the spoke;
// a sheet's contacts and a third triangle leave one freedom, across both of its spokes, in which x is kept.
std::optional<MedialSampler::Ball> MedialSampler::tie_with(const Ball& from, const Vector3d& up, int triangle) const {
  Ball ball = from;
  ball.triangles[ball.count++] = triangle;
  const Vector3d across = from.spokes[0].cross(from.spokes[1]).normalized();
  for (int step = 0; step < kMostNewtonSteps; ++step) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    Eigen::Vector4d rest = Eigen::Vector4d::Zero();
    for (int i = 0; i < ball.count; ++i) {
      const Vector3d spoke = tree_.closest_on(ball.triangles[i], ball.centre).point - ball.centre;
      const double distance = spoke.norm();
      if (!(distance > tolerance_)) return std::nullopt;
      ball.spokes[i] = spoke / distance;
      matrix.row(i) << -ball.spokes[i].transpose(), -1;
      rest[i] = ball.radius - distance;
    }
    if (ball.count == 3) {
      matrix.row(3) << across.transpose(), 0;
      rest[3] = across.dot(from.centre - ball.centre);
    }
    if (rest.cwiseAbs().maxCoeff() <= tolerance_ / 8) {
      return up.dot(ball.centre - from.centre) > 0 ? std::optional<Ball>(ball) : std::nullopt;
    }
    const Eigen::Vector4d change = matrix.partialPivLu().solve(rest);
    if (!(change.norm() <= 10 * tree_.longest_side())) return std::nullopt;  // singular, or divergent
    ball.centre += change.head<3>();
    ball.radius += change[3];
  }
  return std::nullopt;
}

std::vector<MedialSampler::Contact> MedialSampler::contacts(const Ball& ball) const {
  std::vector<Contact> contacts;
  for (const int t : tree_.gather(ball.centre, ball.radius + tolerance_)) {
    if (contacts.size() == kMostContacts) break;
    contacts.push_back({t, (tree_.closest_on(t, ball.centre).point - ball.centre).normalized()});
  }
  return contacts;
}

// A triangle beside a contact ties within the tolerance with a point up to sqrt(2 tolerance / radius) away, as an
// angle, from the contact: the angle is reduced by as much.
double MedialSampler::object_angle(const Ball& ball) const {
  const std::vector<Contact> ties = contacts(ball);
  double largest = 0;
  for (std::size_t i = 0; i < ties.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest = std::max(largest, reference::half_angle(ties[i].spoke, ties[j].spoke));
    }
  }
  return largest - std::sqrt(2 * tolerance_ / ball.radius);
}

namespace {

/// Takes samples while more are needed: until enough reach each angle, and no more than that between two angles.
class Quota {
 public:
  Quota(const std::vector<double>& angles, std::size_t wanted)
      : angles_(angles), wanted_(wanted), between_(angles.size()) {}

  bool take(double angle) {
    const auto above = std::upper_bound(angles_.begin(), angles_.end(), angle);
    if (above == angles_.begin()) return false;
    std::size_t& count = between_[static_cast<std::size_t>(above - angles_.begin()) - 1];
    return count < wanted_ && ++count > 0;
  }

  /// A sample counts for all angles below its own. An angle that very few tries reach is given up: solids have a
  /// largest object angle, and the salient part of a sphere is a point.
  bool is_full(std::uint64_t tries) const {
    std::size_t reaching = 0;
    for (std::size_t i = between_.size(); i-- > 0;) {
      reaching += between_[i];
      const bool rare = tries >= kEnoughTries && reaching * kRare < tries;
      if (reaching < wanted_ && !rare) return false;
    }
    return true;
  }

 private:
  static constexpr std::uint64_t kEnoughTries = 1 << 15, kRare = 400;
  const std::vector<double>& angles_;
  std::size_t wanted_;
  std::vector<std::size_t> between_;  // from angle i to angle i + 1
};

/// results[i] is sample first + i.
void draw_block(const MedialSampler& sampler, std::uint64_t first, unsigned threads,
                std::vector<std::optional<MedialSample>>& results) {
  const auto draw_part = [&](std::size_t part) {
    for (std::size_t i = part; i < results.size(); i += threads) results[i] = sampler.sample(first + i);
  };
  std::vector<std::jthread> others;
  for (unsigned part = 1; part < threads; ++part) others.emplace_back(draw_part, part);
  draw_part(0);
}

}  // namespace

std::vector<MedialSample> draw_medial_samples(const Tree& tree, const SampleRequest& request) {
  std::vector<MedialSample> samples;
  if (request.angles.empty()) return samples;
  const MedialSampler sampler(tree, request.angles.front(), request.seed, request.past_corners);
  const unsigned threads = request.threads > 0 ? request.threads : std::max(1u, std::thread::hardware_concurrency());
  Quota quota(request.angles, request.wanted);
  std::vector<std::optional<MedialSample>> block(4096);
  const std::uint64_t most = request.most_tries * request.wanted;
  for (std::uint64_t first = 0; first < most && !quota.is_full(first); first += block.size()) {
    draw_block(sampler, first, threads, block);
    for (const std::optional<MedialSample>& sample : block) {
      if (sample && quota.take(sample->object_angle)) samples.push_back(*sample);
    }
  }
  return samples;
}

}  // namespace medial_vk::test
