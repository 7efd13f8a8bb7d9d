// How much of a solid hulls of balls cover, by lines in three directions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hull_fits/search/hull_chords.h"
#include "medial_vk/ball_hull.h"
#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// Lattices of lines along the three axes of coordinates. A volume is estimated by the mean of the three sums of chords
/// times the area of a line. Hulls lie in the solid, so that none of their chords must be compared with it; the
/// estimate is a continuous function of them, which small steps can follow. Several threads may use const members.
class CoverageLines {
 public:
  /// With about `lines` lines through the box; others for another `seed`.
  CoverageLines(const Point& lower, const Point& upper, std::size_t lines, std::uint64_t seed = 0);

  /// The volume that a hull covers alone: that of its points in no hull of the set but `except`.
  double gain(const BallHull& hull, std::size_t except) const;
  static constexpr std::size_t kNone = ~std::size_t{0};

  std::size_t size() const { return hulls_.size(); }
  const BallHull& hull(std::size_t i) const { return hulls_[i]; }
  void add(const BallHull& hull);
  /// Takes `hull` for number i.
  void replace(std::size_t i, const BallHull& hull);
  void remove_last();
  /// The volume of the union.
  double covered() const;

 private:
  struct Piece {
    double begin, end;
    std::uint32_t hull;
  };
  using Line = std::vector<Piece>;  // ordered by their begins
  /// Rows of lines that divide the box evenly, each shifted against the one before it, so that no edge of a part is
  /// along lines of several rows.
  struct Lattice {
    double lower_u, lower_v;
    double step_u, step_v;
    std::size_t columns, rows;
    double share;  // of a chord in the estimated volume
    std::vector<Line> lines;

    double first_u(std::size_t row, double shift) const;
    double v(std::size_t row) const { return lower_v + (static_cast<double>(row) + 0.5) * step_v; }
  };

  template <class Visit>
  void for_each_line(const BallHull& hull, const Visit& visit) const;
  void insert(const BallHull& hull, std::uint32_t number);
  void erase(const BallHull& hull, std::uint32_t number);

  double shift_;  // of the first row, as a share of a step
  std::array<Lattice, 3> lattices_;
  std::vector<BallHull> hulls_;
};

}  // namespace medial_vk
