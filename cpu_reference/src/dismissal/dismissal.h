// Proofs about a box: that it holds no salient medial point, or the kind and the greatest width of the salient medial
// points that it may hold (docs/theory.md, "What undecided means").
#pragma once

#include <vector>

#include "dismissal/carriers.h"
#include "dismissal/contacts.h"
#include "dismissal/pairs.h"
#include "geometry/box.h"
#include "geometry/grid.h"

namespace medial_vk::reference {

/// The contacts of a box and, once they are needed, its carriers.
class BoxTest {
 public:
  /// `list` is around the centre of the box and holds all contacts of its points.
  BoxTest(const Tree& tree, const SpokeCones& cones, const Box& box, const ContactList& list);
  BoxTest(const BoxTest&) = delete;  // pairs point to its carriers
  BoxTest& operator=(const BoxTest&) = delete;

  /// True if it is proved that no medial point of this object angle or more lies in the box, inside the solid.
  bool dismisses(double angle);
  /// The first pairs that dismisses() did not exclude, as targets of lines; empty before that call.
  const std::vector<CarrierPair>& pairs() const { return search_.pairs; }

  /// A bound of the distance of two feet of a medial point of this object angle or more in the box (equation 3.1).
  double width(double angle);

  const Box& box() const { return box_; }
  const Closest& nearest() const { return list_.nearest_to_centre(); }
  const std::vector<Contact>& contacts() const { return contacts_; }

 private:
  const std::vector<Carrier>& carriers();
  double width_of(const CarrierPair& pair) const;

  const Tree& tree_;
  const SpokeCones& cones_;
  Box box_;
  const ContactList& list_;
  std::vector<Contact> contacts_;
  std::vector<Carrier> carriers_;
  bool has_carriers_ = false;
  PairSearch search_;
};

/// The kind of a salient medial point that may lie in a leaf cell of a finest voxel with these corners. `test` is that
/// of the cell, `list` its contacts; `angle` is the threshold with which the cell was tested.
UndecidedKind kind_of(const Tree& tree, const SpokeCones& cones, const Thresholds& thresholds, BoxTest& test,
                      const ContactList& list, const Box& voxel);

}  // namespace medial_vk::reference
