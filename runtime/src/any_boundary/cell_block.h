// Cells that lie close together, and the nearest points of the samples that they share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "any_boundary/boundary_queries.h"
#include "any_boundary/cell_grid.h"
#include "any_boundary/spread_test.h"

namespace medial_vk::any_boundary {

/// Cells of one depth whose codes are equal but for the last 3 kDepths bits: of a cube of 8 x 8 x 8 cells.
class CellBlock {
 public:
  static constexpr int kDepths = 3;

  /// Begins anew with other cells, in the order of their codes, and queries the nearest points of their centres.
  void begin(const CellGrid& grid, int depth, std::span<const std::uint64_t> codes, const BoundaryQueries& queries);

  std::size_t cells() const { return codes_.size(); }
  std::uint64_t code(std::size_t cell) const { return codes_[cell]; }
  const Point& centre(std::size_t cell) const { return points_[places_[cell]]; }
  const Point& nearest(std::size_t cell) const { return nearest_[places_[cell]]; }
  bool is_centre_inside(std::size_t cell) const { return inside_[cell] != 0; }

  /// Queries the samples of the cells for which `is_wanted` is not 0.
  void query_samples(std::span<const std::uint8_t> is_wanted, const BoundaryQueries& queries);
  /// The nearest points of the samples of a cell that was wanted, in the order of sample_offsets().
  void contacts(std::size_t cell, std::span<Point, kSamples> contacts) const;
  Point sample(std::size_t cell, std::size_t sample) const;

 private:
  static constexpr int kWidth = (1 << kDepths) + 2 * kSampleReach;

  std::uint32_t place_of_sample(std::size_t cell, std::size_t sample) const;
  void query(const BoundaryQueries& queries);

  double side_ = 0;
  std::span<const std::uint64_t> codes_;
  std::vector<std::uint32_t> places_;    // by cell
  std::vector<std::uint8_t> inside_;     // by cell
  std::vector<Point> points_, nearest_;  // by place
  std::vector<std::uint8_t> is_known_;   // by place
  std::vector<std::uint32_t> wanted_;    // places of the next query
  std::vector<Point> questions_, answers_;
};

}  // namespace medial_vk::any_boundary
