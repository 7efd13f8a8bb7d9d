// The power cell of a ball as a convex polyhedron: a box around the ball, cut by one bisector after the other, or the
// whole cell at once, cut by the walls of that box.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ball_unions/triangulation/bisector.h"
#include "ball_unions/triangulation/regular_triangulation.h"

namespace medial_vk {

/// Three planes meet in every corner and two in every edge: coincidences are decided by ExactSide. Reused for one ball
/// after the other, so that memory is allocated rarely.
class PowerCell {
 public:
  static constexpr std::size_t kWalls = 6;  ///< The first planes of every cell.
  struct Corner {
    Point at;                             ///< Relative to the ball's centre.
    double slack;                         ///< The true corner is at most this far from `at`.
    std::array<std::uint32_t, 3> planes;  ///< Into planes(), with det(normals) > 0.
    /// neighbours[k] is at the other end of the edge that is not in planes[k].
    std::array<std::uint32_t, 3> neighbours;
  };

  explicit PowerCell(std::span<const Ball> balls) : balls_(balls), exact_(balls, walls_) {}
  PowerCell(const PowerCell&) = delete;
  PowerCell& operator=(const PowerCell&) = delete;
  /// For other balls, from the next start() on.
  void use(std::span<const Ball> balls) {
    balls_ = balls;
    exact_.use(balls);
  }
  /// So that cells with so many planes, the six walls not counted, among so many balls allocate nothing.
  void make_room(std::size_t planes, std::size_t balls);
  /// Allocates the memory that the cells of another one needed.
  void make_room_of(const PowerCell& other);

  /// Continues with a cell of ball i, of which these are kept.
  void restore(std::uint32_t i, std::span<const Bisector> planes, std::span<const Corner> corners);

  /// Starts a cell: a box that holds ball i with a margin.
  void start(std::uint32_t i);
  /// Starts with the whole cell, cut to that box. Precondition: the triangulation is of the same balls, and its far
  /// points are among those given to the constructor or to use().
  void start(std::uint32_t i, const RegularTriangulation& triangulation);
  /// Cuts by the plane between the cell's ball and ball j, which has not cut it before. False if nothing was cut off.
  bool clip(std::uint32_t j);
  /// Recomputes with more digits the corners whose planes nearly share a line. It is called after the last cut, since
  /// most corners are cut off before.
  void sharpen();
  bool was_cut_by(std::uint32_t j) const;
  std::uint32_t ball() const { return ball_; }
  bool empty() const { return corners_.empty(); }
  const std::vector<Corner>& corners() const { return corners_; }
  const std::vector<Bisector>& planes() const { return planes_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffu;

  void start_empty(std::uint32_t i);
  std::uint32_t plane_of(std::uint32_t j);
  Corner corner_of(const std::array<std::uint32_t, 3>& planes) const;
  void cut_to_box();
  void cut_by(std::uint32_t plane);
  bool find_cut_corners(const Bisector& plane);
  bool cuts(const Corner& corner, const Bisector& plane, double height) const;
  void add_corners(std::uint32_t plane);
  void link_new_corners(std::uint32_t plane);
  void remove_cut_corners();
  void place_exactly(Corner& corner) const;

  std::span<const Ball> balls_;
  std::uint32_t ball_ = 0;
  std::vector<Wall> walls_;
  mutable ExactSide exact_;
  std::vector<Bisector> planes_;
  std::vector<Corner> corners_;
  double farthest_ = 0;  // no corner is farther away from the centre

  // State of the current cut.
  std::vector<double> heights_;  // of the corners over the plane
  std::vector<std::uint8_t> is_cut_;
  std::vector<std::uint32_t> cut_;       // corners
  std::vector<std::uint32_t> added_;     // corners
  std::vector<std::uint32_t> leaving_;   // by plane: the new corner at which its edge with the new plane starts
  std::vector<std::uint32_t> arriving_;  // by plane: the new corner at which that edge ends
  std::vector<std::uint32_t> plane_of_;  // by ball: its plane, where that plane names the ball
};

}  // namespace medial_vk
