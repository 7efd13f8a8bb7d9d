// Carriers: the convex parts of the boundary that hold the feet of medial points of a box, with the spokes that they
// allow there (docs/theory.md, Lemmas A, C and D).
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "box.h"
#include "contacts.h"
#include "spoke_cones.h"

namespace medial_vk::reference {

/// A face, an edge or a vertex of trusted triangles, or an untrusted triangle with its border.
struct Carrier {
  std::array<Eigen::Vector3d, 3> corners;
  int corner_count;
  /// Normals that span the spokes with weights >= 0; none where that is not known or not used.
  std::array<Eigen::Vector3d, 2> normals;
  int normal_count;
  double normal_cosine;  // of the greatest angle between one of them and an axis near all
  Cap spokes;
  double distance = 0;        // from the centre of the box
  Eigen::Vector3d direction;  // to the nearest point; 0 at distance 0
};

/// The carriers of a box whose contacts are these, nearest first. `nearest` is the boundary point nearest to its
/// centre. Every foot of every medial point of the box inside the solid lies on one of them, with a spoke that it
/// allows.
std::vector<Carrier> carriers_of(const Tree& tree, const SpokeCones& cones, const Box& box, const Closest& nearest,
                                 std::span<const Contact> contacts);

/// Lemma F: is everything on the share-weighted mean of a (share 0) and b (share 1) farther than c, all over the box?
bool is_beaten(const Carrier& a, const Carrier& b, double share, const Carrier& c, const Box& box, double slack);

}  // namespace medial_vk::reference
