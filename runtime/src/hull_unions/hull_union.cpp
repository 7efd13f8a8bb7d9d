// The volume of a union of hulls, by cells of an octree, level by level (docs/theory.md, "Hulls of balls", "Volume of a
// union").
#include "medial_vk/hull_union.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "base/format_text.h"
#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "hull_unions/cut_cube.h"
#include "hull_unions/union_cell.h"

namespace medial_vk {
namespace {

constexpr double kFarthest = 1e18;  // cubes of what is nearer stay far from the ends of double
constexpr std::size_t kMostUnionHulls = 1u << 20;
constexpr std::size_t kMostUnionCells = 1u << 24;  // of all levels: a gigabyte, and some ten seconds
/// A greater width is taken where so many cells are expected. Where few cells are known to be inside or outside, the
/// expected number is too great.
constexpr double kMostExpectedCells = 64.0 * kMostUnionCells;
/// Steps of the search for a threshold: a few to its order of magnitude, the others by halving.
constexpr int kThresholdSteps = 20;

/// A cell of a level, and where the hulls that may meet it are listed.
struct UnionCell {
  std::array<std::uint32_t, 3> index = {};
  std::uint32_t hulls = 0;
  std::size_t first_hull = 0;
};

/// The hulls that meet the cells of one block of a level, one cell after the other.
struct BlockLists {
  std::vector<std::uint32_t> hulls;
  std::vector<std::uint32_t> counts;  // by cell
};

class UnionMeasure {
 public:
  UnionMeasure(std::span<const BallHull> hulls, const HullUnionOptions& options, const std::stop_token& stop)
      : options_(options), watch_(no_progress_, stop), width_(options.width) {
    HullBounds box = {{0, 0, 0}, {0, 0, 0}};
    for (const BallHull& hull : hulls) {
      bool solid = false;
      for (const Ball& ball : hull.balls()) solid = solid || ball.radius > 0;
      if (!solid) continue;  // a point, a segment or a triangle has no volume
      const HullBounds own = bounds_of(hull);
      box = hulls_.queries.empty() ? own : HullBounds{least(box.lower, own.lower), greatest(box.upper, own.upper)};
      hulls_.queries.emplace_back(hull);
    }
    double coordinate = 0, side = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      coordinate = std::max({coordinate, std::fabs(box.lower[k]), std::fabs(box.upper[k])});
      side = std::max(side, box.upper[k] - box.lower[k]);
    }
    // Differences of coordinates, projections, square roots and the distance itself: some 30 roundings of numbers of at
    // most the diagonal of the cube or the greatest coordinate.
    hulls_.rounding = 0x1p-46 * (coordinate + side);
    half_ = 0.5 * side + hulls_.rounding;
    corner_ = 0.5 * (box.lower + box.upper) - Point{half_, half_, half_};
  }

  Result<Bounds> run() {
    if (hulls_.queries.empty()) return Bounds{0, 0};
    lists_.resize(hulls_.queries.size());
    std::iota(lists_.begin(), lists_.end(), 0u);
    cells_ = {{{0, 0, 0}, static_cast<std::uint32_t>(lists_.size()), 0}};
    for (;;) {
      tested_ += cells_.size();
      test_level();
      choose_cells();
      if (divided_.empty()) break;
      if (tested_ + 8 * divided_.size() > kMostUnionCells || level_ == 31) {
        // The bounds are proved as they are; they only differ by more than was requested.
        for (const std::size_t i : divided_) keep(i);
        break;
      }
      divide();
    }
    // The sums are compensated; their error is below one unit in the last place of each and of the product.
    return Bounds{std::max(0.0, lower_.value() * (1 - 0x1p-50)), upper_.value() * (1 + 0x1p-50)};
  }

 private:
  double cell_volume() const { return half_ * half_ * half_; }  // of a unit of CoveredCell

  /// Independent of the number of threads.
  std::size_t block() const { return std::clamp<std::size_t>(cells_.size() / 128, 1, 128); }

  void test_level() {
    covered_.resize(cells_.size());
    const std::size_t block_size = block();
    block_lists_.clear();
    block_lists_.resize((cells_.size() + block_size - 1) / block_size);
    parallel_blocks(cells_.size(), block_size, options_.threads, [&](std::size_t begin, std::size_t end) {
      watch_.check();
      BlockLists& lists = block_lists_[begin / block_size];
      lists.counts.reserve(end - begin);
      std::vector<HullAtCell> meets;
      for (std::size_t i = begin; i < end; ++i) {
        const UnionCell& cell = cells_[i];
        Point centre{};
        for (std::size_t k = 0; k < 3; ++k) centre[k] = corner_[k] + (2.0 * cell.index[k] + 1) * half_;
        covered_[i] = cover_cell(hulls_, centre, half_, {lists_.data() + cell.first_hull, cell.hulls}, meets);
        if (covered_[i].lower == covered_[i].upper) meets.clear();
        lists.counts.push_back(static_cast<std::uint32_t>(meets.size()));
        for (const HullAtCell& hull : meets) lists.hulls.push_back(hull.hull);
      }
    });
  }

  /// Adds up the bounds of cells that are kept, and lists the others in divided_.
  void choose_cells() {
    const double volume = cell_volume();
    // Of a cell that rounding alone keeps from being decided; dividing it would not help.
    const double rounding = volume * (2 * CutCube::kRounding + 64 * hulls_.rounding / half_);
    divided_.clear();
    double open = 0;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (gap_of(i) <= rounding) {
        keep(i);
      } else {
        divided_.push_back(i);
        open += gap_of(i);
      }
    }
    if (divided_.empty()) return;
    // Where rounding has used up the width, as much again is spent on the cells that can still be divided.
    const double kept = kept_gap_.value();
    const double rest = kept < 0.9 * width_ ? width_ - kept : std::max(kept, width_);
    const double greatest = open <= rest ? std::numeric_limits<double>::infinity() : greatest_kept_gap(rest);
    std::size_t count = 0;
    for (const std::size_t i : divided_) {
      if (gap_of(i) <= greatest) {
        keep(i);
      } else {
        divided_[count++] = i;
      }
    }
    divided_.resize(count);
  }

  double gap_of(std::size_t i) const { return cell_volume() * (covered_[i].upper - covered_[i].lower); }

  /// The greatest gap of a cell that is kept, such that the gaps of the kept cells and what dividing is expected to
  /// leave of the others add up to `rest`. Where the boundary is smooth, the gap of a cell of side h is of the order
  /// h^4: of eight parts four have a sixteenth of it each. To divide all cells with more than one gap, and no others,
  /// then takes the fewest cells.
  double greatest_kept_gap(double rest) {
    std::vector<double> gaps;
    gaps.reserve(divided_.size());
    for (const std::size_t i : divided_) gaps.push_back(gap_of(i));
    const auto left_by = [&](double greatest) {
      double sum = 0;
      for (const double gap : gaps) {
        double left = gap, part = gap;
        while (part > greatest) {
          part /= 16;
          left /= 4;
        }
        sum += left;
      }
      return sum;
    };
    double below = 0, above = *std::max_element(gaps.begin(), gaps.end());
    for (int step = 0; step < kThresholdSteps; ++step) {
      const double middle = step < kThresholdSteps / 2 && below == 0 ? above / 256 : (below + above) / 2;
      (left_by(middle) <= rest ? below : above) = middle;
    }
    double cells = 0;
    for (const double gap : gaps) {
      double parts = 8;
      for (double part = gap; part > below && cells < kMostExpectedCells; part /= 16) {
        cells += parts;
        parts *= 4;
      }
    }
    if (cells < kMostExpectedCells) return below;
    width_ += 7 * rest;  // that much cannot be reached
    return greatest_kept_gap(8 * rest);
  }

  void keep(std::size_t i) {
    const double volume = cell_volume();
    lower_.add(volume * covered_[i].lower);
    upper_.add(volume * covered_[i].upper);
    kept_gap_.add(volume * (covered_[i].upper - covered_[i].lower));
  }

  /// The eight parts of each cell in divided_ share the list of its hulls.
  void divide() {
    std::vector<UnionCell> parts;
    std::vector<std::uint32_t> lists;
    parts.reserve(8 * divided_.size());
    std::size_t wanted = 0, cell = 0;
    for (const BlockLists& own : block_lists_) {
      std::size_t first = 0;
      for (std::size_t i = 0; i < own.counts.size(); ++i, ++cell) {
        if (wanted < divided_.size() && divided_[wanted] == cell) {
          ++wanted;
          add_parts(cells_[cell], own.counts[i], lists.size(), parts);
          const auto begin = own.hulls.begin() + static_cast<std::ptrdiff_t>(first);
          lists.insert(lists.end(), begin, begin + own.counts[i]);
        }
        first += own.counts[i];
      }
    }
    cells_ = std::move(parts);
    lists_ = std::move(lists);
    half_ *= 0.5;
    ++level_;
  }

  static void add_parts(const UnionCell& cell, std::uint32_t hulls, std::size_t first_hull,
                        std::vector<UnionCell>& parts) {
    for (std::uint32_t part = 0; part < 8; ++part) {
      UnionCell child;
      for (std::uint32_t k = 0; k < 3; ++k) child.index[k] = 2 * cell.index[k] + ((part >> k) & 1);
      child.hulls = hulls;
      child.first_hull = first_hull;
      parts.push_back(child);
    }
  }

  const HullUnionOptions& options_;
  const ProgressCallback no_progress_;
  const LoopWatch watch_;
  UnionHulls hulls_;
  Point corner_{};
  double half_ = 0;  // of the side of the level's cells
  unsigned level_ = 0;
  std::size_t tested_ = 0;
  double width_;  // that of the options, or a greater one that can be reached
  std::vector<UnionCell> cells_;
  std::vector<std::uint32_t> lists_;
  std::vector<CoveredCell> covered_;
  std::vector<BlockLists> block_lists_;
  std::vector<std::size_t> divided_;
  CompensatedSum lower_, upper_, kept_gap_;
};

std::optional<Error> union_error(std::span<const BallHull> hulls, const HullUnionOptions& options) {
  if (!(options.width > 0)) return Error{ErrorCode::kUsage, "the width of the volume's bounds must be positive"};
  if (hulls.size() > kMostUnionHulls) return Error{ErrorCode::kUsage, "a union has at most 2^20 hulls"};
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    if (hulls[i].count < 1 || hulls[i].count > 3) {
      return Error{ErrorCode::kUsage, format_text("hull {} has {} balls instead of 1 to 3", i, hulls[i].count)};
    }
    for (const Ball& ball : hulls[i].balls()) {
      bool is_near = std::fabs(ball.radius) <= kFarthest;
      for (const double x : ball.centre) is_near = is_near && std::fabs(x) <= kFarthest;
      if (!is_near) return Error{ErrorCode::kUsage, format_text("hull {} is not finite or beyond {:g}", i, kFarthest)};
      if (ball.radius < 0) return Error{ErrorCode::kUsage, format_text("hull {} has a negative radius", i)};
    }
  }
  return std::nullopt;
}

}  // namespace

Result<Bounds> measure_hull_union(std::span<const BallHull> hulls, const HullUnionOptions& options,
                                  const std::stop_token& stop) {
  return catch_out_of_memory("measuring a union of hulls", [&]() -> Result<Bounds> {
    if (const auto error = union_error(hulls, options)) return *error;
    try {
      return UnionMeasure(hulls, options, stop).run();
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace medial_vk
