// The planes that bound the power cell of a ball, and the exact test of the side of a plane on which three others meet.
//
// All coordinates are relative to the centre of the cell's own ball i. The plane of ball j keeps in the cell the points
// x with
//   2 (c_j - c_i) . x <= |c_j - c_i|^2 + r_i^2 - r_j^2                                  (power distances, equation 1.2)
// and a *wall* keeps those with normal . x <= offset.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "base/double_double.h"
#include "base/expansion.h"
#include "medial_vk/ball.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// A plane in double precision: normal . x <= offset is kept.
struct Bisector {
  Point normal;  ///< A unit vector, up to rounding; zero if the two centres coincide.
  double offset = 0;
  double slack = 0;       ///< Bound of the rounding of `offset`.
  std::int32_t ball = 0;  ///< The other ball; below 0: wall number -1 - ball.
  bool is_apart = false;  ///< The two balls have no point in common: no simplex has both.
};

/// True only if they have no point in common, for any rounding: squares carry fewer than 16 roundings of half a unit.
bool are_apart(const Ball& a, const Ball& b);

/// The plane between balls i and j; |c| and r are at most 64.
Bisector bisector(std::span<const Ball> balls, std::uint32_t i, std::uint32_t j);

/// The intersection of three planes, and a bound of its rounding; HUGE_VAL where they are parallel to a line, or
/// nearly.
std::pair<Point, double> meeting_point(const Bisector& p, const Bisector& q, const Bisector& s);

// The displacement by rounding, in radii, above which a corner in the cell's box is recomputed with more digits. Where
// planes nearly have a line in common, rounding may move a corner anywhere along that line, and volumes and simplices
// must not depend on it. Corners outside the ball count too, since edges that pass through the ball end there.
inline constexpr double kSharpCorner = 0x1p-40;
// The displacement above which any corner is recomputed at once, in radii or in the distance from the centre: less
// accurate corners would cause more tests in exact arithmetic, and more walks of the tree.
inline constexpr double kRoughCorner = 0x1p-20;

/// A plane that belongs to one cell only: normal . x <= offset, for exactly these doubles.
struct Wall {
  Point normal;
  double offset = 0;
};

/// Decides exactly. Where the answer is "on the plane", radii are perturbed symbolically: r_k^2 + e_k with e_0 >> e_1
/// >> ... > 0, the same for all cells, so that all cells together are those of one regular triangulation
/// (H. Edelsbrunner, E. P. Muecke, "Simulation of Simplicity", 1990). Not for several threads at once.
class ExactSide {
 public:
  ExactSide(std::span<const Ball> balls, const std::vector<Wall>& walls) : balls_(balls), walls_(walls) {}
  /// For other balls, with the memory of earlier tests.
  void use(std::span<const Ball> balls) { balls_ = balls; }
  /// Allocates the memory of all but tests among numbers of very different sizes.
  void make_room() { arena_.make_room(kUsualRoom); }
  /// Allocates the memory that the tests of another one needed.
  void make_room_of(const ExactSide& other) { arena_.make_room_of(other.arena_); }

  /// True if plane m keeps the point where planes p, q, s of the cell of ball i meet. Their normals are independent.
  /// Each is the number k of a ball, or -1 - k for wall k.
  bool keeps(std::uint32_t i, std::int32_t p, std::int32_t q, std::int32_t s, std::int32_t m);
  /// -1, 0 or 1: the sign of det(c_p - c_i, c_q - c_i, c_s - c_i).
  int orientation(std::uint32_t i, std::uint32_t p, std::uint32_t q, std::uint32_t s);
  /// The intersection of planes p, q, s of the cell of ball i, relative to its centre, and a bound of its rounding: a
  /// few units in the last place of the point's distance, for any flatness of the corner.
  std::pair<Point, double> meet(std::uint32_t i, std::int32_t p, std::int32_t q, std::int32_t s);
  /// For two balls with the same centre: true if the plane between them keeps any point for i, which is the case if i
  /// is larger, or equally large with a smaller number.
  bool keeps_concentric(std::uint32_t i, std::uint32_t j) const {
    if (balls_[i].radius != balls_[j].radius) return balls_[i].radius > balls_[j].radius;
    return i < j;
  }

 private:
  static constexpr std::size_t kUsualRoom = 32'768;  // doubles
  /// A plane as (normal, offset), not scaled.
  template <class Number>
  struct Row {
    Number normal[3], offset;
  };
  /// Signs of the cofactors of the offsets of four planes, and of the sum of those that belong to balls.
  struct Signs {
    std::array<int, 4> cofactors;
    int of_own;
  };
  static bool keeps_tied(std::uint32_t i, const std::array<std::int32_t, 4>& names, const Signs& signs);
  bool keeps_by_expansions(std::uint32_t i, const std::array<std::int32_t, 4>& names);
  std::pair<Point, double> meet_by_expansions(std::uint32_t i, const std::array<std::int32_t, 3>& names);
  Row<DoubleDouble> rounded_row(std::uint32_t i, std::int32_t plane) const;
  Row<Expansion> exact_row(std::uint32_t i, std::int32_t plane);

  std::span<const Ball> balls_;
  const std::vector<Wall>& walls_;
  ExpansionArena arena_;
  ExpansionMath math_{arena_};
};

}  // namespace medial_vk
