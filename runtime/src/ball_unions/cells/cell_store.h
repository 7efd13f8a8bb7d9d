// Power cells that are set aside, in memory that they share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ball_unions/cells/power_cell.h"

namespace medial_vk {

/// Cells come and go, and are of different sizes: what is left of those that have gone is closed up from time to time.
/// So memory is allocated only where all cells together need more than half of it.
class CellStore {
 public:
  /// The place of a cell; none of an empty one.
  struct Place {
    std::uint32_t ball = 0;
    std::size_t first_plane = 0, planes = 0, first_corner = 0, corners = 0;

    bool is_empty() const { return corners == 0; }
  };

  bool has_room_for(const PowerCell& cell) const {
    return planes_.size() + cell.planes().size() <= planes_.capacity() &&
           corners_.size() + cell.corners().size() <= corners_.capacity();
  }
  /// Where has_room_for(): allocates nothing.
  Place keep(const PowerCell& cell);
  void restore(const Place& place, PowerCell& cell) const;
  std::span<const Bisector> planes(const Place& place) const {
    return std::span(planes_).subspan(place.first_plane, place.planes);
  }

  /// Makes room for one more cell, by closing the gaps between these, all that are still needed, and changes their
  /// places. Their order is then that in memory. If it throws std::bad_alloc, nothing has changed.
  void close_gaps(std::span<Place* const> places, const PowerCell& next);
  /// Room for twice of what these, all that are needed, have together. Throws std::bad_alloc.
  void make_room(std::span<Place* const> places);
  void clear();

 private:
  std::vector<Bisector> planes_;
  std::vector<PowerCell::Corner> corners_;
};

}  // namespace medial_vk
