// Points of the boundary that searches nearby have met.
#pragma once

#include <cstddef>
#include <vector>

#include "thickness/ball_kind.h"
#include "thickness/contact_blocks.h"

namespace medial_vk {

/// The last ones, with coordinates of the mesh, to be tried before a distance is computed: that takes as long as to
/// look through hundreds of them.
class ContactPool {
 public:
  /// For searches around p, with the points met at other ones.
  void start(const Point& p, double unit, const Slack& slack);
  /// Counts from the next start() on.
  void add(const BallContact& contact) { met_.push_back(contact); }
  /// The number of the point with the least reach in a direction, if that is less than `reach`; else kNoContact.
  std::uint32_t least_reach(const Point& direction, double reach) const {
    return medial_vk::least_reach(scale_, {blocks_}, direction, reach);
  }
  const BallContact& operator[](std::uint32_t number) const { return contacts_[number]; }

 private:
  static constexpr std::size_t kMost = 128;

  std::vector<BallContact> contacts_, met_;
  std::size_t oldest_ = 0;
  ContactScale scale_;
  std::vector<EightContacts> blocks_;
};

}  // namespace medial_vk
