// Lists of contacts, each a part of another list, for loops over several contacts at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "thickness/contact_bounds.h"
#include "thickness/direction_cell.h"

namespace medial_vk {

/// By contact.
struct ContactArrays {
  std::vector<double> x, y, z, squared;
  std::vector<std::uint32_t> number;

  std::size_t size() const { return x.size(); }
  void resize(std::size_t size);
};

/// All contacts of a point, and lists of those that matter in cells of directions.
class ContactLists {
 public:
  struct List {
    std::uint32_t first = 0, count = 0;
    std::uint32_t seen = 0;  ///< Of all contacts, the list is made of the first ones, so many.
  };
  struct Reach {
    double most = 0;       ///< No centre with a ball that counts is farther from p in any direction of the cell.
    std::uint32_t by = 0;  ///< The contact that shows it, or kNone.
  };
  static constexpr std::uint32_t kNone = 0xffffffffu;

  void clear();
  void add(const Contact& contact);
  std::size_t size() const { return all_.size(); }
  Contact contact(std::size_t i) const { return {{all_.x[i], all_.y[i], all_.z[i]}, all_.squared[i]}; }

  /// Shortens the reach by the contacts of `list` and those added since, and replaces it by the list of those that may
  /// bound balls in a part of the cell: a contact q bounds a ball around s u, with s at most the reach, only if it is
  /// in the ball through p around the farthest centre, |q|^2 <= 2 s u.q.
  Reach narrow(const DirectionCell& cell, const Slack& slack, double reach, List& list);
  /// The same along a ray, by all contacts or those of a list.
  Reach reach_along(const Point& direction, const Slack& slack, double reach);
  Reach reach_along(const Point& direction, const Slack& slack, double reach, const List& list);
  /// From m to a contact, up to rounding; infinite without contacts.
  double least_squared_distance(const Point& m);

  /// Distances from p at which the points in all four directions are within a radius of a contact.
  struct Interval {
    double lower, upper;
    std::uint32_t number;  ///< Of the contact.
  };
  /// Those of the contacts in the list, as far as they reach beyond `from`.
  void intervals_near(const FourDirections& directions, const List& list, double radius, double from,
                      std::vector<Interval>& intervals);

 private:
  Reach least_reach(const ContactArrays& from, std::size_t first, std::size_t count, const Point& direction,
                    const Slack& slack, double reach);
  void measure(const ContactArrays& from, std::size_t first, std::size_t count, const DirectionCell& cell,
               const Slack& slack, double reach);

  ContactArrays all_, listed_;
  std::vector<double> least_, most_, reach_;
};

}  // namespace medial_vk
