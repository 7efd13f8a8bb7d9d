// The contacts of a cell with few sites, and which of them can be equally far in it with nothing nearer.
#pragma once

#include <cstdint>
#include <vector>

#include "plane/diagram/cell_tree.h"
#include "plane/sites/bisector.h"

namespace medial_vk::plane {

/// An object is used by one thread.
class LeafContacts {
 public:
  LeafContacts(const SiteSet& sites, Wanted wanted) : sites_(sites), wanted_(wanted) {}

  void set(const Cell& cell);

  const std::vector<Contact>& all() const { return contacts_; }
  /// One bit for each later contact that can be equally far as `i` somewhere in the cell, with no site nearer there
  /// (docs/theory.md, "The exact axis", lemma on pairs).
  std::uint64_t partners(std::size_t i) const { return partners_[i]; }

 private:
  void set_distances(const Cell& cell);
  void add(const Cell& cell, Contact contact);
  bool has_nearer() const;

  const SiteSet& sites_;
  Wanted wanted_;
  std::vector<Contact> contacts_;
  std::vector<std::uint64_t> partners_;
  std::size_t corners_ = 0;
  std::vector<double> farthest_;  // of the sites, from the corners
  std::vector<double> bounds_;    // of the contacts' distances, at the corners
  std::vector<double> means_;     // of two contacts' bounds
};

}  // namespace medial_vk::plane
