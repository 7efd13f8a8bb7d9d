// The regular triangulation of balls (weighted Delaunay triangulation): dual to all their power cells at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ball_unions/triangulation/bisector.h"
#include "medial_vk/ball.h"

namespace medial_vk {

class BallInsertion;
class WorkerPool;

/// Two balls are joined by an edge if their power cells share a face, four by a tetrahedron if theirs share a corner.
/// Ties are broken as in ExactSide, so that the result depends neither on rounding nor on the order of insertion. It
/// includes four points far from all balls, so that every cell is bounded; no point of a ball has a smaller power to
/// one of them than to that ball. O(n log n) for balls of which each has a bounded number of neighbours.
class RegularTriangulation {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kFarPoints = 4;
  struct Tetrahedron {
    std::array<std::uint32_t, 4> balls;       ///< det(c_1 - c_0, c_2 - c_0, c_3 - c_0) > 0.
    std::array<std::uint32_t, 4> neighbours;  ///< neighbours[k] shares all but balls[k]; kNone if there is none.
  };

  /// The corners except number k, in an order with det(c_a - c_k, c_b - c_k, c_c - c_k) > 0.
  static constexpr std::array<std::array<std::size_t, 3>, 4> kOthers = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

  /// The intersection of four power cells, relative to the centre of balls[0], and a bound of its rounding.
  struct Corner {
    Point from_first;
    double slack;
  };

  /// Balls as scaled_balls() makes them: coordinates and radii up to 1; fewer than 2^30. `order`: all of them, with
  /// most neighbours in space after each other. No value if there are more than 24 tetrahedra per ball, with an
  /// allowance for few balls: medial and random balls have 7, but two rods that pass each other, or a ring and its
  /// axis, n^2 / 4, as every ball of one may be joined to all of the other, at any distance.
  static std::optional<RegularTriangulation> build(std::span<const Ball> balls, std::span<const std::uint32_t> order,
                                                   unsigned threads);

  /// No triangulation that is not given up has more. Of n + 4 points it has at most (n + 5) (n + 2) / 2 - 4, by the
  /// upper bound theorem for the sphere that it and a cone over its four outer faces are.
  static std::size_t most_tetrahedra(std::size_t balls);

  /// No balls.
  RegularTriangulation() = default;
  /// The same in the memory of the triangulation before and of `insertion`; false where build() has no value, and then
  /// this object holds no triangulation. Allocates nothing where the memory of the two calls before suffices.
  bool rebuild(std::span<const Ball> balls, std::span<const std::uint32_t> order, BallInsertion& insertion,
               WorkerPool& pool);

  /// So that triangulations of so many balls on so many threads allocate nothing here; and in their insertion neither,
  /// if that has room for them.
  void make_room(std::size_t balls, unsigned threads);

  /// All input balls, followed by the far points as balls of radius 0.
  std::span<const Ball> balls() const { return balls_; }
  bool is_far(std::uint32_t ball) const { return ball + kFarPoints >= balls_.size(); }
  std::span<const Tetrahedron> tetrahedra() const { return tetrahedra_; }
  const Corner& corner(std::uint32_t tetrahedron) const { return corners_[tetrahedron]; }
  /// The tetrahedra around a ball; none if its power cell is empty.
  std::span<const std::uint32_t> around(std::uint32_t ball) const {
    return std::span(around_).subspan(first_[ball], first_[ball + 1] - first_[ball]);
  }
  /// The position of tetrahedron t among those around its ball number k.
  std::uint32_t position_around(std::uint32_t t, std::size_t k) const { return positions_[t][k]; }

 private:
  /// Of one thread at a time.
  struct ExactCorners {
    std::vector<Wall> no_walls;
    ExactSide side{{}, no_walls};
  };
  void sort_into_rounds(std::span<const std::uint32_t> order);
  void add_far_points();
  void list_stars();
  void place_corners(WorkerPool& pool);
  Corner place_corner(const Tetrahedron& t, ExactSide& exact) const;

  std::vector<Ball> balls_;
  std::vector<Tetrahedron> tetrahedra_;
  std::vector<Corner> corners_;                          // by tetrahedron
  std::vector<std::array<std::uint32_t, 4>> positions_;  // by tetrahedron
  std::vector<std::size_t> first_;                       // by ball: into around_
  std::vector<std::uint32_t> around_;
  std::vector<std::uint32_t> rounds_;                 // all balls, in the order in which they are added
  std::vector<std::uint32_t> counts_;                 // by ball, for list_stars()
  std::vector<std::unique_ptr<ExactCorners>> exact_;  // by worker
};

}  // namespace medial_vk
