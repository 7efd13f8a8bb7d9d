#include "medial_vk/least_wall.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "least_wall/wall_cells.h"

namespace medial_vk {
namespace {

// Of the half side of the whole.
constexpr double kSmallestShare = 0x1p-36;

// Of Solid::rounding(): centres of cells are rounded by u times their coordinates in each of some 36 divisions, and it
// holds four such errors. Cells are larger than that by another factor.
constexpr double kRoundings = 16, kSmallestRoundings = 8;

// Of the same: smaller cells beside a vertex are tested for the cone there.
constexpr double kVertexShare = 0x1p-14;

constexpr std::size_t kCellsAtATime = 4096, kCellsOfABlock = 16;

Status check(const IndexedMesh& mesh, const LeastWallOptions& options) {
  const auto usage = [](const char* message) { return Error{ErrorCode::kUsage, message}; };
  const double angle = options.object_angle;
  if (!(angle > 0.25 * std::numbers::pi && angle < 0.5 * std::numbers::pi)) {
    return usage("`object_angle` must be between pi / 4 and pi / 2");
  }
  if (!(options.width >= 1e-6 && options.width <= 1)) return usage("`width` must be from 1e-6 to 1");
  if (!(std::isfinite(options.limit) && options.limit >= 0)) return usage("`limit` must be a length, or 0");
  if (options.cells == 0) return usage("`cells` must be positive");
  if (!mesh.prepared().report.closed) return usage("the least wall is proved for closed meshes alone");
  return {};
}

/// Divides the cells with the least bounds, many at a time, so that the result does not depend on threads.
class LeastWallSearch {
 public:
  LeastWallSearch(const WallField& field, const WallCell& whole, const std::stop_token& stop)
      : field_(field),
        stop_(stop),
        smallest_(std::max(kSmallestShare * whole.half, kSmallestRoundings * field.rounding)),
        best_(0.5 * field.options.limit) {
    add(whole);
  }

  LeastWall run(const ProgressCallback& progress) {
    while (examined_ < field_.options.cells && is_worth_dividing()) {
      divide_some();
      const double share = static_cast<double>(examined_) / static_cast<double>(field_.options.cells);
      if (progress) progress(std::min(share, 1.0));
    }
    if (progress) progress(1);
    const double least = open_.empty() ? best_ : std::min(best_, open_.front().least);
    return {{2 * least, 2 * best_ * (1 + 0x1p-40)}, thinnest_, examined_};
  }

 private:
  bool is_worth_dividing() const {
    return !open_.empty() && !is_near_enough(open_.front().least) && open_.front().half > smallest_;
  }
  bool is_near_enough(double least) const { return least * (1 + field_.options.width) >= best_; }

  void add(const WallCell& cell) {
    if (!(cell.least < best_) || is_free_beside_vertex(cell)) return;
    open_.push_back(cell);
    open_.back().number = number_++;
    std::push_heap(open_.begin(), open_.end(), kIsLater);
  }

  /// Cells beside a vertex would be divided without end, as the boundary there looks the same at every scale.
  bool is_free_beside_vertex(const WallCell& cell) {
    if (!cell.vertex || cell.half > field_.small) return false;
    check_stop();
    const Point& vertex = *cell.vertex;
    auto known = free_around_.find(vertex);
    if (known == free_around_.end()) known = free_around_.emplace(vertex, WallCells(field_).free_around(vertex)).first;
    const Point offset = cell.centre - vertex;
    const double farthest = std::max({std::fabs(offset[0]), std::fabs(offset[1]), std::fabs(offset[2])}) + cell.half;
    return farthest + field_.rounding < known->second * (1 - 0x1p-40);
  }

  void check_stop() const {
    if (stop_.stop_requested()) throw LoopStopped();
  }

  void divide_some() {
    check_stop();
    cells_.clear();
    const std::size_t most = std::min<std::size_t>(kCellsAtATime, field_.options.cells - examined_);
    while (cells_.size() < most && is_worth_dividing()) {
      std::pop_heap(open_.begin(), open_.end(), kIsLater);
      for (std::size_t i = 0; i < 8; ++i) cells_.push_back(open_.back().part(i));
      open_.pop_back();
    }
    found_.assign(cells_.size(), std::nullopt);
    parallel_blocks(cells_.size(), kCellsOfABlock, field_.options.threads, [&](std::size_t begin, std::size_t end) {
      WallCells examiner(field_);
      for (std::size_t i = begin; i < end; ++i) found_[i] = examiner.examine(cells_[i], best_);
    });
    examined_ += cells_.size();
    for (const std::optional<WallBall>& found : found_) {
      if (!found || !(found->ball.radius < best_)) continue;
      best_ = found->ball.radius;
      thinnest_ = found;
    }
    for (const WallCell& cell : cells_) add(cell);
  }

  static constexpr auto kIsLater = [](const WallCell& a, const WallCell& b) {
    return a.least != b.least ? a.least > b.least : a.number > b.number;
  };

  const WallField& field_;
  const std::stop_token& stop_;
  double smallest_;  // cells are not divided further, as rounding decides there
  double best_;      // the least radius that was found, or half the limit
  std::optional<WallBall> thinnest_;
  std::vector<WallCell> open_;           // a heap
  std::map<Point, double> free_around_;  // by vertex
  std::vector<WallCell> cells_;
  std::vector<std::optional<WallBall>> found_;
  std::uint64_t examined_ = 0, number_ = 0;
};

/// Centres of balls that touch in two points are close to the middle between these: within r cos theta, and r is at
/// most half the diagonal over sin theta.
WallCell whole_of(const Bvh& bvh, double theta) {
  const BvhBox& box = bvh.nodes().front().box;
  const Point size = box.upper - box.lower;
  const double beyond = 0.5 * length(size) / std::tan(theta);
  return {.centre = 0.5 * (box.lower + box.upper),
          .half = (0.5 * std::max({size[0], size[1], size[2]}) + beyond) * (1 + 0x1p-40)};
}

}  // namespace

Result<LeastWall> measure_least_wall(const IndexedMesh& mesh, const LeastWallOptions& options,
                                     const ProgressCallback& progress, const std::stop_token& stop) {
  if (const Status status = check(mesh, options); !status.ok()) return status.error();
  return catch_out_of_memory("searching for the least wall", [&]() -> Result<LeastWall> {
    Result<Solid> solid = Solid::build(mesh);
    if (!solid) return solid.error();
    const WideTree& tree = solid.value().wide_tree();
    const std::vector<SpokeCone> normals = normals_of(solid.value());
    try {
      const WallCell whole = whole_of(solid.value().bvh(), options.object_angle);
      WallField field = {
          solid.value(), tree, normals, options, kVertexShare * whole.half, kRoundings * solid.value().rounding()};
      if (options.limit == 0) field.options.limit = mesh.longest_side();
      return LeastWallSearch(field, whole, stop).run(progress);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace medial_vk
