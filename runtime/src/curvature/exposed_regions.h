// The parts of a ball's sphere that no other ball covers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ball_unions/cells/power_cell.h"

namespace medial_vk {

/// A part of a sphere of radius 1 that is bounded by one closed curve.
struct ExposedRegion {
  double area = 0;
  Point vector = {0, 0, 0};     ///< The integral of the outward unit normals over it, by area.
  Point direction = {0, 0, 0};  ///< That, of unit length: the mean direction.
  /// No point of the region is farther away from the direction, radians; pi where it may not lie in a half-sphere.
  double reach = 0;
};

/// For one thread: the memory is used again for each ball.
class RegionFinder {
 public:
  /// The exposed regions of the ball of a cell, of this radius, in radii. The caps that other balls cover form one
  /// piece or several; the regions are those that one of them leaves, the one whose border has the most closed curves,
  /// and together they contain what is exposed. None where nothing is exposed, and where no two caps cross on the
  /// border of what is. (docs/theory.md, "Curvature from balls", "Exposed regions")
  std::span<const ExposedRegion> find(const PowerCell& cell, double radius);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  /// A point where the border of a face of the cell crosses the sphere. The border of the region follows the circle of
  /// `plane` from here to `next`, clockwise as seen from outside, over the angle `sweep`.
  struct Crossing {
    Point at;
    std::uint32_t plane = 0;
    std::uint32_t next = kNone;
    double sweep = 0;
  };
  /// An edge of the cell in one of its two senses: the one that goes around a face counterclockwise.
  struct HalfEdge {
    std::uint32_t enter = kNone, leave = kNone;  ///< The crossings into the ball and out of it, in this order.
    bool was_walked = false;
  };

  void find_crossings(const PowerCell& cell, double radius);
  void walk_face(const PowerCell& cell, double radius, std::uint32_t first);
  std::uint32_t piece_of(std::uint32_t plane);
  std::uint32_t widest_piece();
  void add_region(const PowerCell& cell, double radius, std::uint32_t first);

  std::vector<Crossing> crossings_;
  std::vector<HalfEdge> half_edges_;    // by corner and slot: 3 corner + slot
  std::vector<std::uint32_t> pieces_;   // by plane: another one of the same piece, or itself
  std::vector<std::uint32_t> borders_;  // by plane, of pieces: the closed curves of the border
  std::vector<std::uint32_t> lengths_;  // and its crossings
  std::vector<std::uint32_t> firsts_;   // a crossing of each closed curve
  std::vector<std::uint8_t> was_seen_;
  std::vector<ExposedRegion> regions_;
};

}  // namespace medial_vk
