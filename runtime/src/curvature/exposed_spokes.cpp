#include "curvature/exposed_spokes.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "ball_unions/cells/ball_tree.h"
#include "ball_unions/cells/cell_builder.h"
#include "ball_unions/unions/unit_balls.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "threads/worker_pool.h"

namespace medial_vk {
namespace {

// Balls of smaller object angles carry little of the boundary (kNestedSlope).
constexpr double kLeastObjectAngle = 0.25;
// In spacings: balls nearer than this do not count.
constexpr std::array<double, 3> kNeglected = {0, 2, 4};
// Balls in a row that one thread takes.
constexpr std::size_t kInARow = 256;

double angle_of_regions(const ExposedRegion& a, const ExposedRegion& b) {
  return std::atan2(length(cross(a.direction, b.direction)), dot(a.direction, b.direction));
}

/// Whether the cones around both have a direction in common.
bool may_touch(const ExposedRegion& a, const ExposedRegion& b) { return angle_of_regions(a, b) <= a.reach + b.reach; }

ExposedRegion joined(const ExposedRegion& a, const ExposedRegion& b) {
  ExposedRegion out = {a.area + b.area, a.vector + b.vector, a.direction, 0};
  if (const double size = length(out.vector); size > 0) out.direction = 1 / size * out.vector;
  out.reach = std::max(angle_of_regions(out, a) + a.reach, angle_of_regions(out, b) + b.reach);
  return out;
}

/// For one thread. It takes memory and time for all balls once, and then for each search what is near.
class SpokeSearch {
 public:
  SpokeSearch(const SheetLinks& links, std::span<const Ball> scaled, const BallTree& tree)
      : links_(links), scaled_(scaled), counted_(tree), builder_(scaled, tree, &counted_) {}

  /// Of a row of balls; the result does not depend on earlier rows.
  void find_all(std::span<const std::uint32_t> numbers, std::span<ExposedSpokes> out, const std::stop_token& stop) {
    builder_.forget();
    for (std::size_t i = 0; i < numbers.size() && !stop.stop_requested(); ++i) out[i] = find(numbers[i]);
  }

 private:
  ExposedSpokes find(std::uint32_t ball) {
    ExposedSpokes best;
    const double radius = scaled_[ball].radius;
    if (!(radius > 0)) return best;  // nothing is left of it beside the greatest number
    for (const double reach : kNeglected) {
      if (reach > 0) count_near(ball, reach * links_.spacing(), false);
      const ExposedSpokes found = spokes_of(finder_.find(builder_.build(ball), radius));
      if (reach > 0) count_near(ball, reach * links_.spacing(), true);
      if (found.count > best.count) best = found;
      if (best.count == 2) break;
    }
    return best;
  }

  void count_near(std::uint32_t ball, double reach, bool counts) {
    links_.grid().visit_within(links_.centres()[ball], reach,
                               [&](std::uint32_t other, double) { counted_.set(other, counts); });
  }

  const SheetLinks& links_;
  std::span<const Ball> scaled_;
  BallMask counted_;
  CellBuilder builder_;
  RegionFinder finder_;
};

}  // namespace

ExposedSpokes spokes_of(std::span<const ExposedRegion> regions) {
  std::vector<ExposedRegion> apart;
  apart.reserve(regions.size());
  for (ExposedRegion region : regions) {
    // What is joined reaches farther, and may touch others that were apart.
    for (std::size_t i = 0; i < apart.size();) {
      if (!may_touch(region, apart[i])) {
        ++i;
        continue;
      }
      region = joined(region, apart[i]);
      apart[i] = apart.back();
      apart.pop_back();
      i = 0;
    }
    apart.push_back(region);
  }
  ExposedSpokes out;
  const std::size_t count = std::min<std::size_t>(apart.size(), 2);
  std::ranges::partial_sort(apart, apart.begin() + static_cast<std::ptrdiff_t>(count), std::ranges::greater(),
                            &ExposedRegion::area);
  if (count == 1 && apart[0].reach >= kLeastObjectAngle) return out;
  out.count = count;
  for (std::size_t i = 0; i < count; ++i) {
    out.spokes[i] = apart[i].direction;
    out.reaches[i] = apart[i].reach;
  }
  return out;
}

std::vector<ExposedSpokes> exposed_spokes(const SheetLinks& links, std::span<const std::uint32_t> numbers,
                                          unsigned threads, const std::stop_token& stop) {
  std::vector<ExposedSpokes> out(numbers.size());
  if (numbers.empty()) return out;
  const std::vector<Ball> scaled = scaled_balls(links.balls(), scale_of(links.balls()));
  const BallTree tree(scaled, threads);
  const std::size_t rows = (numbers.size() + kInARow - 1) / kInARow;
  WorkerPool pool(static_cast<unsigned>(std::min<std::size_t>(thread_count(threads), rows)));
  std::vector<std::unique_ptr<SpokeSearch>> searches(pool.threads());
  pool.run(rows, 1, [&](std::size_t row, unsigned worker) {
    std::unique_ptr<SpokeSearch>& search = searches[worker];
    if (search == nullptr) search = std::make_unique<SpokeSearch>(links, scaled, tree);
    const std::size_t begin = row * kInARow, count = std::min(kInARow, numbers.size() - begin);
    search->find_all(numbers.subspan(begin, count), std::span(out).subspan(begin, count), stop);
  });
  return out;
}

}  // namespace medial_vk
