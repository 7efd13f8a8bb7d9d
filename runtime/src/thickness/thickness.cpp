#include "medial_vk/thickness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/host_memory.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "base/point_order.h"
#include "thickness/ball_direction.h"
#include "thickness/largest_ball_near.h"

namespace medial_vk {
namespace {

constexpr std::size_t kPointsAtATime = 128;  // that one thread takes, neighbours in space

Error usage(const char* message) { return {ErrorCode::kUsage, message}; }

Status check(std::span<const Point> points, const ThicknessOptions& options) {
  const auto is_length = [](double x) { return std::isfinite(x) && x >= 0; };
  if (!is_length(options.delta)) return usage("`delta` must be a length, or 0");
  if (!is_length(options.limit)) return usage("`limit` must be a length, or 0");
  if (!(options.width >= 1e-6 && options.width <= 1)) return usage("`width` must be from 1e-6 to 1");
  if (options.queries == 0) return usage("`queries` must be positive");
  if (!(options.wall_angle <= std::numbers::pi / 2)) return usage("`wall_angle` must be at most pi / 2");
  if (!(options.crease_angle >= 0 && options.crease_angle <= options.wall_angle)) {
    return usage("`crease_angle` must be from 0 to `wall_angle`");
  }
  constexpr std::size_t kMostPoints = std::size_t{1} << 31;
  if (points.size() > kMostPoints) return usage("`points` must be at most 2^31 points");
  constexpr double kMost = 1e18;  // squares of distances, and their products, are finite
  const auto is_point = [](const Point& p) {
    return std::ranges::all_of(p, [](double x) { return std::fabs(x) <= kMost; });
  };
  if (!std::ranges::all_of(points, is_point)) return usage("`points` must have coordinates of at most 1e18");
  return {};
}

std::vector<Thickness> measure(const ThicknessField& field, std::span<const Point> points,
                               const ProgressCallback& progress, const std::stop_token& stop) {
  const ThicknessOptions& options = field.options;
  std::vector<Thickness> found(points.size());
  const std::vector<std::uint32_t> order = order_along_curve(points);
  LoopWatch watch(progress, stop);
  parallel_blocks(points.size(), kPointsAtATime, options.threads, [&](std::size_t begin, std::size_t end) {
    LargestBallNear search(field);
    std::vector<std::uint32_t> nearby;
    for (std::size_t i = begin; i < end; ++i) {
      watch.check();
      const Point& p = points[order[i]];
      found[order[i]] = search.find(p, direction_of_balls(field.solid, p, options.delta, options.side, nearby));
    }
    watch.finish(end - begin, points.size());
  });
  return found;
}

}  // namespace

Result<std::vector<Thickness>> measure_thickness(const IndexedMesh& mesh, std::span<const Point> points,
                                                 const ThicknessOptions& options, const ProgressCallback& progress,
                                                 const std::stop_token& stop) {
  if (const Status status = check(points, options); !status.ok()) return status.error();
  return catch_out_of_memory("measuring thickness", [&]() -> Result<std::vector<Thickness>> {
    Result<Solid> solid = Solid::build(mesh);
    if (!solid) return solid.error();
    const WideTree& tree = solid.value().wide_tree();
    ThicknessField field = {solid.value(), tree, options};
    if (options.delta == 0) field.options.delta = mesh.longest_side() / 2000;
    if (options.limit == 0) field.options.limit = mesh.longest_side();
    try {
      return measure(field, points, progress, stop);
    } catch (const LoopStopped&) {
      return LoopStopped::error();
    }
  });
}

}  // namespace medial_vk
