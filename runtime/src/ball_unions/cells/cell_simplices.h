// The simplices of the dual complex: the faces, edges and corners of a power cell that lie in its ball.
#pragma once

#include <vector>

#include "ball_unions/cells/power_cell.h"
#include "medial_vk/dual_complex.h"

namespace medial_vk {

/// Appends the simplices whose first ball is the cell's, and the vertices of the envelope likewise. Scratch memory is
/// reused between calls.
class SimplexCollector {
 public:
  void collect(const PowerCell& cell, const Ball& ball, DualComplex& complex, std::vector<EnvelopeVertex>& vertices);

  /// So that it allocates nothing for cells of so many planes.
  void make_room(std::size_t planes) { faces_.reserve(planes); }
  /// So that it allocates nothing for cells that the other has taken.
  void make_room_of(const SimplexCollector& other) { faces_.reserve(other.faces_.capacity()); }

 private:
  enum : std::uint8_t { kFootOutside = 1, kMeetsBall = 2 };
  void collect_edges(const PowerCell& cell, const Ball& ball, DualComplex& complex,
                     std::vector<EnvelopeVertex>& vertices);
  void collect_corners(const PowerCell& cell, double radius, DualComplex& complex) const;

  std::vector<std::uint8_t> faces_;  // by plane of the cell
};

}  // namespace medial_vk
