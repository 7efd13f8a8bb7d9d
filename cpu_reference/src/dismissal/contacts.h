// Contact lists: the triangles that can be nearest to points of a ball or a box (docs/theory.md, Lemma A), inherited
// from the ball of a larger cell, and the proof by one cone that no salient medial point lies there (Lemmas B and C).
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "cpu_reference/queries.h"
#include "geometry/box.h"

namespace medial_vk::reference {

struct Contact {
  Eigen::Vector3d direction;  // g_t: unit, from the centre to the nearest point of the triangle
  double distance;            // D_t
  int triangle;
  bool trusted;
};

/// Lemma A for a box: the sets that a point of the box can touch. Let t be a convex set at distance D from the centre
/// c, in direction g, and t0 the triangle nearest to c. dist(c + x, t) >= D - g . x, and dist(c + x, t0) is convex in
/// x. If t is touched from some x of the box, dist(c + x, t0) - D + g . x is at least 0 there, so it is at one of the
/// corners.
class BoxReach {
 public:
  BoxReach(const Tree& tree, const Box& box, int nearest_triangle);
  bool touches(double distance, const Eigen::Vector3d& direction) const;

 private:
  std::array<Eigen::Vector3d, 8> corners_;  // from the centre
  std::array<double, 8> distances_;         // of t0 from the corners
};

/// The triangles that can hold a nearest boundary point of some point of the ball (centre, reach).
class ContactList {
 public:
  /// From the tree: for top-level cells.
  ContactList(const Tree& tree, const Mesh& mesh, const Eigen::Vector3d& centre, double reach);
  /// From the list of a ball or box that holds all query points, without the tree.
  ContactList(const ContactList& parent, const Eigen::Vector3d& centre, double reach);

  const Eigen::Vector3d& centre() const { return centre_; }
  const Closest& nearest_to_centre() const { return nearest_; }
  const Eigen::Vector3d& nearest_direction() const { return nearest_direction_; }
  std::span<const Contact> contacts() const { return contacts_; }

  /// Nearest boundary point of p, which must lie in the ball.
  Closest closest(const Eigen::Vector3d& p) const;

  /// Contacts of a smaller ball around the same centre, and of a box around it.
  std::vector<Contact> within(double reach) const;
  std::vector<Contact> within(const Box& box) const;

 private:
  void measure(int triangle, const Eigen::Vector3d& centre, double reach);
  bool can_touch(const Contact& contact, double reach) const;

  const Tree* tree_;
  const Mesh* mesh_;
  Eigen::Vector3d centre_;
  Closest nearest_;
  Eigen::Vector3d nearest_direction_;
  std::vector<Contact> contacts_;
};

/// True if one cone of this half-angle proves that no medial point with this object angle or more lies inside the solid
/// within a ball of this radius, or a box in it, with these contacts.
bool spokes_are_close(const Tree& tree, std::span<const Contact> contacts, double reach, double angle);

}  // namespace medial_vk::reference
