// Carriers: the convex parts of the boundary that hold the feet of medial points of a box, with the spokes that they
// allow there (docs/theory.md, Lemmas A, C, D and I).
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "dismissal/contacts.h"
#include "dismissal/spoke_cones.h"
#include "geometry/box.h"

namespace medial_vk::reference {

/// A face from one side, an edge or a vertex; or a triangle without a known normal, with its border.
struct Carrier {
  std::array<Eigen::Vector3d, 3> corners;
  int corner_count;
  /// Normals that span the spokes with weights >= 0; none if unknown or not used.
  std::array<Eigen::Vector3d, 2> normals;
  int normal_count;
  double normal_cosine;  // of the greatest angle between one of them and an axis near all of them
  Cap spokes;
  const Arc* arc = nullptr;                            // of the spokes to an edge of an untrusted triangle
  std::array<int, 3> vertices = {-1, -1, -1};          // of the mesh: the corners of a face or an edge
  std::array<int, 3> triangle_corners = {-1, -1, -1};  // of the untrusted triangle that lists it; -1: of a trusted one
  double distance = 0;                                 // from the centre of the box
  Eigen::Vector3d direction;                           // to the nearest point; 0 at distance 0
};

/// The carriers of a box with these contacts, nearest first. `nearest` is the boundary point nearest to its centre.
/// Every foot of every medial point of the box inside the solid lies on one of them, with a spoke that it allows.
std::vector<Carrier> carriers_of(const Tree& tree, const SpokeCones& cones, const Box& box, const Closest& nearest,
                                 std::span<const Contact> contacts);

/// Lemma F: true if the weighted mean of the distances of a (share 0) and b (share 1) is above the distance of c, in
/// the whole box.
bool is_beaten(const Carrier& a, const Carrier& b, double share, const Carrier& c, const Box& box, double slack);

}  // namespace medial_vk::reference
