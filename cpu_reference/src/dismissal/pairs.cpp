#include "dismissal/pairs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "dismissal/common_corner.h"
#include "dismissal/joint_conditions.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

constexpr double kCosineSlack = 1e-12;       // dots of unit vectors and cosines are off by less than 1e-15
constexpr std::size_t kMostCarriers = 2000;  // the search is quadratic
constexpr std::size_t kMostRivals = 16;      // nearest carriers that are tried for Lemma F

/// True if either carrier lies in the untrusted triangle that lists the other. No two feet are in one triangle.
bool are_of_one_triangle(const Carrier& a, const Carrier& b) {
  const auto holds = [](const std::array<int, 3>& corners, const Carrier& c) {
    const auto is_corner = [&](int v) {
      return v >= 0 && std::find(corners.begin(), corners.end(), v) != corners.end();
    };
    return std::all_of(c.vertices.begin(), c.vertices.end(), is_corner);
  };
  return holds(a.triangle_corners, b) || holds(b.triangle_corners, a);
}

class PairTest {
 public:
  PairTest(const Tree& tree, const Box& box, std::span<const Carrier> carriers, double angle)
      : box_(box),
        rivals_(carriers.first(std::min(carriers.size(), kMostRivals))),
        angle_(angle),
        sine_(std::sin(angle)),
        size_(tree.longest_side()),
        slack_(8 * tree.rounding()) {}

  bool can_be_salient(const Carrier& a, const Carrier& b) const {
    return spokes_can_part(a.spokes, b.spokes) && !are_of_one_triangle(a, b) && can_face(a, b) && can_face(b, a) &&
           can_be_at_corner(a, b) && !is_beaten_by_a_third(a, b) &&
           can_hold_jointly(a, b, rivals_, box_, angle_, slack_ / 8);
  }

 private:
  /// True if two spokes of these caps can be 2 * angle apart: not if the axes are nearer than 2 * angle less both
  /// angles.
  bool spokes_can_part(const Cap& a, const Cap& b) const {
    const double left = 2 * angle_ - a.angle - b.angle;
    return left <= 0 || a.axis.dot(b.axis) <= std::cos(left) + kCosineSlack;
  }

  bool can_face(const Carrier& a, const Carrier& b) const;

  /// Lemma J, if a triangle that lists one of them is not trusted.
  bool can_be_at_corner(const Carrier& a, const Carrier& b) const {
    const bool applies = a.triangle_corners[0] >= 0 || b.triangle_corners[0] >= 0;
    return !applies || can_meet_at_corner(a, b, angle_);
  }

  // Lemma F, at the share for which the mean direction is nearest to the third's.
  bool is_beaten_by_a_third(const Carrier& a, const Carrier& b) const {
    const Vector3d across = b.direction - a.direction;
    const double squared = across.squaredNorm();
    return std::any_of(rivals_.begin(), rivals_.end(), [&](const Carrier& c) {
      if (&c == &a || &c == &b) return false;
      const double share = squared > 0 ? std::clamp(across.dot(c.direction - a.direction) / squared, 0.0, 1.0) : 0.5;
      return is_beaten(a, b, share, c, box_, slack_);
    });
  }

  const Box& box_;
  std::span<const Carrier> rivals_;
  double angle_, sine_, size_, slack_;
};

/// Unit vectors from the corners of one carrier to those of another (without common corners), and their mean.
struct Chords {
  Chords(const Carrier& from, const Carrier& to) {
    for (int i = 0; i < from.corner_count; ++i) {
      for (int j = 0; j < to.corner_count; ++j) {
        const Vector3d d = to.corners[j] - from.corners[i];
        const double length = d.norm();
        if (length > 0) units[count++] = d / length;
      }
    }
    mean = Vector3d::Zero();
    for (int i = 0; i < count; ++i) mean += units[i];
    mean /= std::max(mean.norm(), 1e-300);
  }
  std::array<Vector3d, 9> units;
  int count = 0;
  Vector3d mean;
};

/// The greatest -s . d of all s of an arc. The part of d across the edge, reversed, is `turn` away from the middle.
double depth_along(const Arc& arc, const Vector3d& d) {
  const Vector3d across = d - d.dot(arc.along) * arc.along;
  const double size = across.norm();
  if (size == 0) return 0;
  const double turn = 2 * half_angle(-across / size, arc.middle);
  return size * std::cos(std::max(0.0, turn - arc.angle));
}

/// True if a part of b is behind a, as seen along -s for a spoke s at a: the greatest -s . d of chords d is above the
/// slack.
template <typename Depth>
bool is_behind(const Depth& depth, const Carrier& a, const Carrier& b, double slack) {
  for (int i = 0; i < a.corner_count; ++i) {
    for (int j = 0; j < b.corner_count; ++j) {
      if (depth(b.corners[j] - a.corners[i]) > slack) return true;
    }
  }
  return false;
}

// Lemma E: is -n . c >= sin(angle) cos(phi) possible for a normal n at a, for the direction c of a chord from a to b?
// A chord is a mean of corner differences d, and for a unit vector e with d . e > 0 for all of them it is at least as
// long as its part along e: -n . c is at most the greatest -n . d / d . e. Taking the unit vectors along d changes no
// ratio.
// A corner that is behind by less than 1e-9 of the mesh's size (the error of a normal, 5e-10, times a length) counts as
// not behind: only balls of a radius below 1e-9 / (sin(angle)^2 cos(phi)) of it are lost, which no voxel resolves.
// Elsewhere -n . d is off by 5e-10 and d . e is at least kLeastAlong, so ratios below 1 are off by less than 2e-8;
// spokes at flat edges and vertices are within kFaceAngle = 1e-7 of the normal of a face.
bool PairTest::can_face(const Carrier& a, const Carrier& b) const {
  constexpr double kLeastAlong = 0.05, kRatioSlack = 2e-7;
  const auto faces = [&](const auto& depth, double least) {
    if (!is_behind(depth, a, b, 1e-9 * size_)) return false;
    const Chords chords(a, b);
    for (int i = 0; i < chords.count; ++i) {
      const double along = chords.units[i].dot(chords.mean);
      if (along < kLeastAlong || depth(chords.units[i]) >= least * along) return true;
    }
    return false;
  };
  if (a.arc != nullptr) {
    return faces([&](const Vector3d& d) { return depth_along(*a.arc, d); }, sine_ - kRatioSlack);
  }
  if (a.normal_count == 0) return true;
  for (int k = 0; k < a.normal_count; ++k) {
    const Vector3d& n = a.normals[k];
    if (faces([&](const Vector3d& d) { return -n.dot(d); }, sine_ * a.normal_cosine - kRatioSlack)) return true;
  }
  return false;
}

}  // namespace

PairSearch salient_pairs(const Tree& tree, const Box& box, std::span<const Carrier> carriers, double angle,
                         std::size_t most) {
  PairSearch search;
  if (carriers.size() > kMostCarriers) {
    search.complete = false;
    carriers = carriers.first(kMostCarriers);
  }
  const PairTest test(tree, box, carriers, angle);
  for (std::size_t i = 0; i < carriers.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!test.can_be_salient(carriers[j], carriers[i])) continue;
      if (search.pairs.size() == most) {
        search.complete = false;
        return search;
      }
      search.pairs.push_back({&carriers[j], &carriers[i]});
    }
  }
  return search;
}

}  // namespace medial_vk::reference
