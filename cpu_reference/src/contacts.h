// Contact lists: which triangles the points of a ball can be nearest to (certified dismissal, Lemma 1), inherited
// from the ball of a larger cell, and the proof that no salient medial point lies in the ball (Lemmas 2 and 3).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {

struct Contact {
  Eigen::Vector3d direction;  // g_t: unit, from the centre to the nearest point of the triangle
  double distance;            // D_t
  int triangle;
  bool trusted;
};

/// The triangles that some point of the ball (centre, reach) can have a nearest boundary point on.
class ContactList {
 public:
  /// From the tree: for top-level cells.
  ContactList(const Tree& tree, const Mesh& mesh, const Eigen::Vector3d& centre, double reach);
  /// From the list of a ball that contains this one: all others need the tree no more.
  ContactList(const ContactList& parent, const Eigen::Vector3d& centre, double reach);

  const Eigen::Vector3d& centre() const { return centre_; }
  const Closest& nearest_to_centre() const { return nearest_; }
  const Eigen::Vector3d& nearest_direction() const { return nearest_direction_; }
  std::span<const Contact> contacts() const { return contacts_; }

  /// Nearest boundary point of p, which must lie in the ball.
  Closest closest(const Eigen::Vector3d& p) const;

  /// Contacts of a smaller ball around the same centre.
  std::vector<Contact> within(double reach) const;
  std::vector<Contact> within_cube(double half) const;

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

/// True if it is proved that no medial point with this object angle or more lies within `reach` of the centre,
/// inside the solid. `contacts` are those of that ball.
bool spokes_are_close(const Tree& tree, std::span<const Contact> contacts, double reach, double angle);
bool no_pair_is_salient(const Tree& tree, std::span<const Contact> contacts, double reach, double angle);

}  // namespace medial_vk::reference
