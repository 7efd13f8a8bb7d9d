// Independent samples of the medial surface of a solid, by distances in double precision only, against which the recall
// of an extraction is measured. They share the closest-point queries with the CPU reference, and nothing else.
//
// The solid may be the outside of a mesh, within a box (reference::turned_over()).
//
// A random point p of the solid has a nearest boundary point A. The largest ball that touches A and whose interior
// holds no boundary point has its centre on the ray from A through p and touches the boundary elsewhere: its centre is
// a medial point. It is found from outside (Ma, Bae and Choi 2012): a ball that holds a boundary point Q in its
// interior shrinks until it touches A and Q, |AQ|^2 / (2 n.AQ), and so on; every Q proves that the ball must not be
// larger.
//
// On facets that represent a smooth surface these balls mostly touch neighbouring facets, under a small object angle,
// and the salient medial surface of a tube is a curve that no random ray meets. A sample may therefore climb: along the
// sheet of its contacts, until a third triangle ties; along that seam, until a fourth does. Ties are solved by Newton's
// method. If all salient points are next to one point, as in a sphere, it continues along the steepest seam from corner
// to corner.
//
// On any path, a sample is kept only after its whole ball has been examined: its interior is empty up to the tolerance,
// and its object angle is the largest between two triangles that tie within the tolerance.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cpu_reference/queries.h"

namespace medial_vk::test {

/// Lengths in the units of the mesh, the angle in radians.
struct MedialSample {
  Eigen::Vector3d centre;
  double radius;        ///< Distance to the boundary, exact to rounding.
  double object_angle;  ///< Half the largest angle between spokes to contacts that tie, never too large by rounding.
};

/// Makes sample number `index` of the sequence that belongs to `seed`, independently of all others.
class MedialSampler {
 public:
  /// Samples below `least_angle` are not used: they climb further, and are finally dropped. Keeps a reference.
  MedialSampler(const reference::Tree& tree, double least_angle, std::uint64_t seed, bool past_corners = false);

  /// Nothing if the random point is outside, or the sample is not salient.
  std::optional<MedialSample> sample(std::uint64_t index) const;

  /// The greatest difference in distance between contacts that tie: 64 times the bound on the rounding of one distance,
  /// a few 1e-13 of the longest side.
  double tolerance() const { return tolerance_; }

 private:
  struct Contact;
  struct Ball;
  std::optional<MedialSample> on_the_way_up(std::optional<Ball> ball, std::uint64_t which) const;
  std::optional<Ball> largest_at(const reference::Closest& contact, const Eigen::Vector3d& away) const;
  std::optional<Ball> climb(const Ball& from) const;
  std::optional<Ball> climb_from_corner(const Ball& corner) const;
  std::optional<Ball> tie_with(const Ball& from, const Eigen::Vector3d& up, int triangle) const;
  std::vector<Contact> contacts(const Ball& ball) const;
  double object_angle(const Ball& ball) const;

  const reference::Tree& tree_;
  double least_angle_, tolerance_;
  std::uint64_t seed_;
  bool past_corners_;
  Eigen::AlignedBox3d box_of_mesh_;
};

struct SampleRequest {
  std::vector<double> angles;    ///< Ascending: at least `wanted` samples reach each of them, as long as there are any.
  std::size_t wanted = 0;        ///< By angle; and no more than that between two of them.
  std::size_t most_tries = 100;  ///< Random points, as a multiple of `wanted`.
  std::uint64_t seed = 1;
  unsigned threads = 0;       ///< 0: all. The samples do not depend on it.
  bool past_corners = false;  ///< Continue to climb where four contacts tie.
};

/// Samples in the order of the sampler's sequence.
std::vector<MedialSample> draw_medial_samples(const reference::Tree& tree, const SampleRequest& request);

}  // namespace medial_vk::test
