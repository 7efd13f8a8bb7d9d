#include "medial_vk/shrinking_union.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ball_unions/cells/ball_in_cell.h"
#include "ball_unions/cells/cell_builder.h"
#include "ball_unions/cells/cell_simplices.h"
#include "ball_unions/unions/simplex_lists.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/host_memory.h"
#include "base/parallel.h"
#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kBallsAtOnce = 64;
// Per cube of the radius: for smaller volumes, rounding may decide whether a ball meets its cell.
constexpr double kSliver = 0x1p-30;

/// The measures of the power cell of one ball.
struct CellMeasures {
  double volume = 0;
  bool is_hidden = false;                 // none of the ball is in its cell, or nearly none
  std::vector<std::uint32_t> neighbours;  // balls that bound the cell
  DualComplex simplices;                  // those whose first ball this is
};

}  // namespace

class ShrinkingUnion::Impl {
 public:
  Impl(std::span<const Ball> balls, unsigned threads)
      : scale_(scale_of(balls)),
        balls_(scaled_balls(balls, scale_)),
        threads_(thread_count(threads)),
        tree_(balls_, threads_),
        mask_(tree_),
        cells_(balls.size()),
        volumes_(balls.size()) {
    std::vector<std::pair<std::uint32_t, CellMeasures>> all = measure(tree_.order());
    for (auto& [i, cell] : all) put(i, std::move(cell));
  }

  double volume() const { return careful_sum(volumes_); }
  std::span<const double> volumes() const { return volumes_; }
  bool holds(std::uint32_t ball) const { return mask_.holds(ball); }
  std::span<const std::uint32_t> changed() const { return changed_; }
  std::size_t size() const { return cells_.size(); }

  Result<BettiNumbers> betti() const {
    DualComplex complex;
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
      if (!mask_.holds(i)) continue;
      append(complex, cells_[i].simplices);
    }
    std::vector<EnvelopeVertex> none;
    make_complete(complex, none);
    return betti_numbers(complex);
  }

  void remove(std::span<const std::uint32_t> balls) {
    std::vector<std::uint32_t> gone(balls.begin(), balls.end());
    sort_unique(gone);
    std::erase_if(gone, [&](std::uint32_t i) { return !mask_.holds(i); });
    for (const std::uint32_t i : gone) mask_.set(i, false);
    std::vector<std::pair<std::uint32_t, CellMeasures>> changed;
    std::vector<std::uint32_t> touched;
    try {
      touched = touched_by(gone);
      changed = measure(in_tree_order(touched));
    } catch (...) {
      for (const std::uint32_t i : gone) mask_.set(i, true);
      throw;
    }
    gone_ = std::move(gone);
    changed_ = std::move(touched);
    for (auto& [i, cell] : changed) std::swap(cell, cells_[i]);
    before_ = std::move(changed);
    for (const std::uint32_t i : gone_) volumes_[i] = 0;
    for (const auto& [i, cell] : before_) refresh_volume(i);
  }

  void undo() {
    for (const std::uint32_t i : gone_) mask_.set(i, true);
    for (auto& [i, cell] : before_) put(i, std::move(cell));
    for (const std::uint32_t i : gone_) refresh_volume(i);
    before_.clear();
    gone_.clear();
    changed_.clear();
  }

 private:
  void put(std::uint32_t i, CellMeasures cell) {
    cells_[i] = std::move(cell);
    refresh_volume(i);
  }
  void refresh_volume(std::uint32_t i) { volumes_[i] = cells_[i].volume / scale_ / scale_ / scale_; }

  /// Balls whose cell grows by the removal of others. If the cell of ball k grows, the face of its cell with a
  /// removed ball meets both balls, as the later cell is convex: k is among the neighbours of that ball. A ball without
  /// a cell may get one where it overlaps a removed ball.
  std::vector<std::uint32_t> touched_by(const std::vector<std::uint32_t>& gone) const {
    std::vector<std::uint32_t> touched;
    for (const std::uint32_t i : gone) append(touched, cells_[i].neighbours);
    for (std::uint32_t i = 0; i < cells_.size(); ++i) {
      if (cells_[i].is_hidden && mask_.holds(i) && overlaps_any(i, gone)) touched.push_back(i);
    }
    std::erase_if(touched, [&](std::uint32_t i) { return !mask_.holds(i); });
    sort_unique(touched);
    return touched;
  }

  bool overlaps_any(std::uint32_t i, const std::vector<std::uint32_t>& others) const {
    const Ball& a = balls_[i];
    return std::any_of(others.begin(), others.end(), [&](std::uint32_t j) {
      const Ball& b = balls_[j];
      return length(b.centre - a.centre) <= a.radius + b.radius;
    });
  }

  /// Neighbours in space follow each other, which reduces the cost of their cells.
  std::vector<std::uint32_t> in_tree_order(const std::vector<std::uint32_t>& sorted) const {
    std::vector<std::uint32_t> result;
    if (sorted.size() * 8 < cells_.size()) return sorted;
    for (const std::uint32_t i : tree_.order()) {
      if (std::binary_search(sorted.begin(), sorted.end(), i)) result.push_back(i);
    }
    return result;
  }

  std::vector<std::pair<std::uint32_t, CellMeasures>> measure(std::span<const std::uint32_t> balls) const {
    std::vector<std::pair<std::uint32_t, CellMeasures>> result(balls.size());
    parallel_blocks(balls.size(), kBallsAtOnce, threads_, [&](std::size_t begin, std::size_t end) {
      CellBuilder builder(balls_, tree_, &mask_);
      SimplexCollector collector;
      for (std::size_t n = begin; n < end; ++n) {
        result[n].first = balls[n];
        measure(builder, collector, balls[n], result[n].second);
      }
    });
    return result;
  }

  void measure(CellBuilder& builder, SimplexCollector& collector, std::uint32_t i, CellMeasures& measures) const {
    const Ball& ball = balls_[i];
    if (ball.radius == 0) return;
    const PowerCell& cell = builder.build(i);
    measures.is_hidden = true;
    if (cell.empty()) return;
    measures.volume = measure_ball_in_cell(cell, ball.radius).volume;
    const auto neighbours = builder.neighbours();
    measures.neighbours.assign(neighbours.begin() + 1, neighbours.end());
    std::vector<EnvelopeVertex> unused;
    collector.collect(cell, ball, measures.simplices, unused);
    measures.is_hidden =
        measures.simplices.vertices.empty() || measures.volume <= kSliver * ball.radius * ball.radius * ball.radius;
  }

  double scale_;
  std::vector<Ball> balls_;
  unsigned threads_;
  BallTree tree_;
  BallMask mask_;
  std::vector<CellMeasures> cells_;
  std::vector<double> volumes_;
  // State of the last removal.
  std::vector<std::uint32_t> gone_, changed_;
  std::vector<std::pair<std::uint32_t, CellMeasures>> before_;
};

ShrinkingUnion::ShrinkingUnion(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
ShrinkingUnion::ShrinkingUnion(ShrinkingUnion&&) noexcept = default;
ShrinkingUnion& ShrinkingUnion::operator=(ShrinkingUnion&&) noexcept = default;
ShrinkingUnion::~ShrinkingUnion() = default;

Result<ShrinkingUnion> ShrinkingUnion::build(std::span<const Ball> balls, const ShrinkingUnionOptions& options) {
  if (const Status status = check_balls(balls); !status.ok()) return status.error();
  return catch_out_of_memory("measuring a union of balls", [&]() -> Result<ShrinkingUnion> {
    return ShrinkingUnion(std::make_unique<Impl>(balls, options.threads));
  });
}

double ShrinkingUnion::volume() const { return impl_->volume(); }
std::span<const double> ShrinkingUnion::volumes() const { return impl_->volumes(); }
bool ShrinkingUnion::holds(std::uint32_t ball) const { return impl_->holds(ball); }
Result<BettiNumbers> ShrinkingUnion::betti() const {
  return catch_out_of_memory("counting the holes of a union of balls", [&] { return impl_->betti(); });
}
std::span<const std::uint32_t> ShrinkingUnion::changed() const { return impl_->changed(); }
void ShrinkingUnion::undo() { impl_->undo(); }

Status ShrinkingUnion::remove(std::span<const std::uint32_t> balls) {
  return catch_out_of_memory("removing balls from a union", [&]() -> Status {
    for (const std::uint32_t i : balls) {
      if (i < impl_->size()) continue;
      return Error{ErrorCode::kUsage, "no ball " + std::to_string(i) + ": there are " + std::to_string(impl_->size())};
    }
    impl_->remove(balls);
    return {};
  });
}

}  // namespace medial_vk
