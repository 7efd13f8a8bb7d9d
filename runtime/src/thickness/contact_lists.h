// Lists of contacts, each a part of another list, for loops over several contacts at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "thickness/contact_blocks.h"
#include "thickness/contact_bounds.h"
#include "thickness/direction_cell.h"

namespace medial_vk {

/// All contacts of a point, and lists of those that matter in cells of directions. Contacts are chosen in float, and
/// what they show is computed in double precision.
class ContactLists {
 public:
  struct List {
    std::uint32_t first = 0, count = 0;  ///< Blocks.
    std::uint32_t seen = 0;              ///< Of all contacts, the list is made of the first ones, so many.
  };
  struct Reach {
    double most = 0;       ///< No centre with a ball that counts is farther from p in any direction of the cell.
    std::uint32_t by = 0;  ///< The contact that shows it, or kNone.
  };
  static constexpr std::uint32_t kNone = kNoContact;

  /// Without contacts. `unit` is a length of the size of distances in question.
  void start(double unit, const Slack& slack);
  void add(const Contact& contact);
  std::size_t size() const { return all_.size(); }
  const Contact& contact(std::size_t i) const { return all_[i]; }
  const ContactScale& scale() const { return scale_; }

  /// Shortens the reach by the contacts of `list` and those added since, and replaces it by the list of those that may
  /// bound balls in a part of the cell: a contact q bounds a ball around s u, with s at most the reach, only if it is
  /// in the ball through p around the farthest centre, |q|^2 <= 2 s u.q.
  Reach narrow(const DirectionCell& cell, double reach, List& list);
  /// The same along a ray, by all contacts or those of a list.
  Reach reach_along(const Point& direction, double reach) const;
  Reach reach_along(const Point& direction, double reach, const List& list) const;
  /// From m to a contact, up to rounding; infinite without contacts.
  double least_squared_distance(const Point& m) const;
  ContactRange range_of(const List& list) const;

 private:
  Reach reach_of(std::uint32_t number, const Point& direction, double reach) const;

  Slack slack_;
  ContactScale scale_;
  std::vector<Contact> all_;
  std::vector<EightContacts> blocks_;  // of all contacts
  std::vector<EightContacts> listed_;  // of the lists
  std::vector<EightContacts::Eight> most_;
  std::vector<std::uint8_t> places_;
};

}  // namespace medial_vk
