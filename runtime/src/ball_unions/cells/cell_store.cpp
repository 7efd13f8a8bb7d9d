#include "ball_unions/cells/cell_store.h"

#include <algorithm>
#include <bit>

namespace medial_vk {
namespace {

/// Room for twice of what is needed, and for as much again that has gone.
std::size_t ample(std::size_t needed) { return std::bit_ceil(4 * needed); }

struct Sizes {
  std::size_t planes = 0, corners = 0;
};

Sizes sizes_of(std::span<CellStore::Place* const> places) {
  Sizes sum;
  for (const CellStore::Place* place : places) {
    sum.planes += place->planes;
    sum.corners += place->corners;
  }
  return sum;
}

template <class T>
void make_room_for(std::vector<T>& values, std::size_t needed) {
  if (2 * needed > values.capacity()) values.reserve(ample(needed));
}

/// Moves a range of the array down to a place before it.
template <class T>
void move_down(std::vector<T>& values, std::size_t first, std::size_t count, std::size_t to) {
  const auto from = values.begin() + static_cast<std::ptrdiff_t>(first);
  std::copy(from, from + static_cast<std::ptrdiff_t>(count), values.begin() + static_cast<std::ptrdiff_t>(to));
}

}  // namespace

CellStore::Place CellStore::keep(const PowerCell& cell) {
  const Place place = {cell.ball(), planes_.size(), cell.planes().size(), corners_.size(), cell.corners().size()};
  planes_.insert(planes_.end(), cell.planes().begin(), cell.planes().end());
  corners_.insert(corners_.end(), cell.corners().begin(), cell.corners().end());
  return place;
}

void CellStore::restore(const Place& place, PowerCell& cell) const {
  cell.restore(place.ball, planes(place), std::span(corners_).subspan(place.first_corner, place.corners));
}

void CellStore::close_gaps(std::span<Place* const> places, const PowerCell& next) {
  const Sizes needed = sizes_of(places);
  make_room_for(planes_, needed.planes + next.planes().size());
  make_room_for(corners_, needed.corners + next.corners().size());
  std::size_t planes = 0, corners = 0;
  for (Place* place : places) {
    move_down(planes_, place->first_plane, place->planes, planes);
    move_down(corners_, place->first_corner, place->corners, corners);
    place->first_plane = planes;
    place->first_corner = corners;
    planes += place->planes;
    corners += place->corners;
  }
  planes_.resize(planes);
  corners_.resize(corners);
}

void CellStore::make_room(std::span<Place* const> places) {
  const Sizes needed = sizes_of(places);
  planes_.reserve(ample(needed.planes));
  corners_.reserve(ample(needed.corners));
}

void CellStore::clear() {
  planes_.clear();
  corners_.clear();
}

}  // namespace medial_vk
