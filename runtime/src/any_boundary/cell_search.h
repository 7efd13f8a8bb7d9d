// One depth of the certified search: cells are dismissed, and salient points searched for in those that are left.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "any_boundary/aimed_lines.h"
#include "any_boundary/cell_block.h"
#include "any_boundary/spread_test.h"

namespace medial_vk::any_boundary {

/// A cell that may hold a salient medial point.
struct OpenCell {
  std::uint64_t code = 0;
  double width = 0;            ///< The greatest distance between two contacts of such a point.
  bool is_near_angle = false;  ///< Such a point has an object angle below the threshold plus 0.05.
  bool is_shallow = false;     ///< Such a point has a radius below the side of a voxel.
};

struct FoundBall {
  std::uint64_t voxel = 0;
  ApproximateBall ball;
};

struct SearchedCells {
  std::vector<OpenCell> open;
  std::vector<FoundBall> found;
};

/// The parts of the search that all threads read.
struct SearchFrame {
  const CellGrid& grid;
  const BoundaryQueries& queries;
  const SpreadTest& test;
  Salience salience;
  double epsilon;  // in the units of the points
};

/// For one thread at a time.
class CellSearch {
 public:
  explicit CellSearch(const SearchFrame& frame)
      : frame_(frame), narrowing_(frame.grid, frame_.salience, frame.epsilon, frame.queries) {}

  /// Appends to `out`. The cells are those of a CellBlock.
  void run(int depth, std::span<const std::uint64_t> codes, SearchedCells& out);

 private:
  bool is_outside(std::size_t cell) const;
  double distance(std::size_t cell) const;
  double least_angle(std::size_t cell) const;
  bool is_dismissed(std::size_t cell, double object_angle) const;
  void aim(std::size_t cell, int depth);
  void aim_at_tie(std::uint64_t voxel, const Point& centre, const Point& a,
                  const std::array<Point, kSamples>& contacts);

  const SearchFrame& frame_;
  LineNarrowing narrowing_;
  double side_ = 0, half_diagonal_ = 0;
  CellBlock block_;
  std::vector<std::uint8_t> is_wanted_;
  std::vector<AimedLine> lines_;
};

}  // namespace medial_vk::any_boundary
