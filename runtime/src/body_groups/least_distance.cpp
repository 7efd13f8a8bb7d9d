#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <stop_token>
#include <utility>

#include "base/eight_floats.h"
#include "base/format_text.h"
#include "base/loop_watch.h"
#include "base/parallel.h"
#include "base/point_ops.h"
#include "body_groups/group_parts.h"
#include "proximity/pair_query.h"

namespace medial_vk {
namespace {

constexpr std::size_t kWidth = BodyNode::kWidth;

/// The pose of `b` in the frame of `a`, both given in a common frame. The inverse of a rotation is its transpose, but
/// for its defect.
Pose relative(const Pose& a, const Pose& b) {
  Pose pose;
  const Point away = b.shift - a.shift;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point column = {a.rotation[0][i], a.rotation[1][i], a.rotation[2][i]};
    for (std::size_t j = 0; j < 3; ++j) {
      pose.rotation[i][j] = column[0] * b.rotation[0][j] + column[1] * b.rotation[1][j] + column[2] * b.rotation[2][j];
    }
    pose.shift[i] = dot(column, away);
  }
  return pose;
}

/// Two parts that may be the closest. Many of these are never written, and so have no initial values.
struct CloseParts {
  float separation;  ///< No more than that of their balls.
  std::uint32_t part_a, part_b;
  std::uint32_t link_a, link_b;

  PartPair parts() const { return {part_a, part_b}; }
};

/// One query. Preconditions of the public call hold.
class LeastSearch {
 public:
  LeastSearch(const BodyGroupImpl& group, const Pose* poses, const GroupOptions& options, const std::stop_token& stop)
      : group_(group), poses_(poses), options_(options), stop_(stop) {
    best_.lower = std::max(options.limit, std::numeric_limits<double>::min());
    reach_ = best_.lower;
  }

  /// Throws LoopStopped after a request to stop.
  LeastDistance run(const LeastDistance& start) {
    begin(start);
    const auto sweep_all = [&]() __attribute__((always_inline)) {
      for (const LinkPair& links : group_.compared) {
        if (best_.upper == 0) break;
        sweep(links);
      }
    };
    run_on_this_processor(sweep_all);
    drain();
    best_.lower = std::min(best_.lower, best_.upper);
    return best_;
  }

 private:
  /// The parts that were the closest before.
  void begin(const LeastDistance& start) {
    const PartPair &upper = start.upper_pair, &lower = start.lower_pair;
    if (is_compared(upper)) examine(close_parts(upper), &start);
    if (best_.upper > 0 && lower != upper && is_compared(lower)) examine(close_parts(lower), &start);
  }

  bool is_compared(const PartPair& parts) const {
    if (parts.a >= group_.parts.size() || parts.b >= group_.parts.size()) return false;
    const LinkPair links = {group_.parts[parts.a].link, group_.parts[parts.b].link};
    return std::ranges::any_of(group_.compared, [&](const LinkPair& pair) {
      return pair == links || pair == LinkPair{links.b, links.a};
    });
  }

  CloseParts close_parts(const PartPair& parts) const {
    return {-kFarther, parts.a, parts.b, group_.parts[parts.a].link, group_.parts[parts.b].link};
  }

  /// The parts of the second link, one after the other, against the tree of the first.
  MEDIAL_VK_INLINE void sweep(const LinkPair& links) {
    const PlacedLink &first = group_.links[links.a], &second = group_.links[links.b];
    const Pose &pose_a = poses_[links.a], &pose_b = poses_[links.b];
    const double shifts = length(pose_a.shift) + length(pose_b.shift);
    if (!(shifts + first.extent + second.extent <= 6 * kLargestCoordinate)) {
      prove_nothing({first.parts.front(), second.parts.front()});
      return;
    }
    for (const std::uint32_t part : second.parts) {
      if (stop_.stop_requested()) throw LoopStopped();
      const PlacedPart& placed = group_.placed[part];
      const Point away = (pose_b * placed.ball.centre) - pose_a.shift;
      std::array<float, 3> centre;
      for (std::size_t i = 0; i < 3; ++i) {
        const Point column = {pose_a.rotation[0][i], pose_a.rotation[1][i], pose_a.rotation[2][i]};
        centre[i] = static_cast<float>(dot(column, away) - first.centre[i]);
      }
      // A separation of two balls has an error of at most 9 2^-24 of this sum, as in separation_error(), and rounding
      // in double is far below the difference to 20.
      const double error = 20 * 0x1p-24 * (shifts + first.extent + placed.extent) + 0x1p-60;
      const float radius = rounded_up(placed.ball.radius);
      visit_near(first.tree, centre, radius, error, [&](std::uint32_t item, float between) {
        add(first.tree.leaf(item), {first.parts[item], part}, links, between, radius, error);
      });
    }
  }

  /// Visits the balls of the tree that are closer than the reach to a ball: their items, and distances of centres.
  template <class Visit>
  MEDIAL_VK_INLINE void visit_near(const BodyTree& tree, const std::array<float, 3>& centre, float radius, double error,
                                   const Visit& visit) {
    std::array<std::uint32_t, 1 + (kWidth - 1) * node_levels(kMostBodyBalls * 256)> nodes;
    nodes[0] = 0;
    for (std::size_t count = 1; count > 0;) {
      const BodyNode& node = tree.nodes().node(nodes[--count]);
      const EightFloats x = load(node.centre[0]) - centre[0], y = load(node.centre[1]) - centre[1],
                        z = load(node.centre[2]) - centre[2];
      const EightFloats squared = x * x + y * y + z * z;
      const EightFloats reach = load(node.radius) + (radius + reach_in_float(error));
      std::uint32_t near = bits_of((squared < reach * reach) & (reach > 0));
      const std::array<float, kWidth> squares = stored(squared);
      for (; near != 0; near &= near - 1) {
        const auto k = static_cast<std::uint32_t>(std::countr_zero(near));
        if (node.is_lowest) {
          visit(node.below[k], std::sqrt(squares[k]));
        } else {
          nodes[count++] = node.below[k];
        }
      }
    }
  }

  float reach_in_float(double error) const { return reach_ < kFarther ? rounded_up(reach_ + error) : kFarther; }

  /// Solids are no farther apart than the farthest points of balls around them.
  void add(const FloatBall& of_first, const PartPair& parts, const LinkPair& links, float between, float radius,
           double error) {
    const double radii = static_cast<double>(of_first.radius) + radius;
    const double separation = between - radii - error;
    if (separation >= reach_) return;
    reach_ = std::min(reach_, between + radii + error);
    if (count_ == kMostClose) drain();
    if (best_.upper == 0) return;
    close_[count_++] = {-rounded_up(-separation), parts.a, parts.b, links.a, links.b};
  }

  /// Examines the parts found so far, the closest first, since it excludes most others.
  void drain() {
    if (count_ == 0) return;
    const auto closest = std::min_element(close_.begin(), close_.begin() + static_cast<std::ptrdiff_t>(count_),
                                          [](const auto& a, const auto& b) { return a.separation < b.separation; });
    std::swap(*closest, close_[0]);
    for (std::size_t i = 0; i < count_ && best_.upper > 0; ++i) {
      if (close_[i].separation < reach_) examine(close_[i], nullptr);
    }
    count_ = 0;
  }

  void examine(const CloseParts& close, const LeastDistance* start) {
    if (stop_.stop_requested()) throw LoopStopped();
    const GroupPart &a = group_.parts[close.part_a], &b = group_.parts[close.part_b];
    const PlacedPart &placed_a = group_.placed[close.part_a], &placed_b = group_.placed[close.part_b];
    const Pose &pose_a = poses_[close.link_a], &pose_b = poses_[close.link_b];
    Pose pose = relative(pose_a, pose_b);
    if (placed_b.is_moved) pose = pose * b.pose;
    if (placed_a.is_moved) pose = relative(a.pose, pose);
    // Three motions, each with ten roundings of this sum, and the defects: docs/theory.md, "Many bodies".
    const double size = length(pose_a.shift) + length(pose_b.shift) + placed_a.extent + placed_b.extent;
    const double defects = defect_of(pose_a) + (placed_a.is_moved ? placed_a.defect : 0);
    const PairQuery query(a.body, b.body, pose, (3 * defects + 40 * 0x1p-53) * 1.1 * size);
    if (!query.is_in_range()) {
      prove_nothing(close.parts());
    } else if (options_.exact) {
      by_triangles(query, close.parts(), start);
    } else {
      by_balls(query, close, start);
    }
    reach_ = std::min(reach_, best_.upper);
  }

  void by_balls(const PairQuery& query, const CloseParts& close, const LeastDistance* start) {
    const PartPair parts = close.parts();
    BallPair covers, insides;
    if (start && parts == start->lower_pair) covers = start->balls.cover_pair;
    if (start && parts == start->upper_pair) insides = start->balls.inside_pair;
    if (query.has_covers()) {
      const double lower = query.lower_bound(best_.lower, covers);
      // Only collisions are to be decided, and these parts are free.
      if (options_.limit == 0 && lower > 0) return;
      shorten_lower(lower, parts, covers);
    } else if (close.separation > -kFarther) {
      // There are still the balls around the parts. Of a start they are unknown, and the sweep finds them.
      shorten_lower(std::max(0.0, static_cast<double>(close.separation)), parts, {});
    }
    if (!query.has_insides()) return;
    const double upper = query.upper_bound(best_.upper, insides);
    if (!(upper < best_.upper)) return;
    best_.upper = upper;
    best_.upper_pair = parts;
    best_.balls.inside_pair = insides;
    if (upper == 0) end_with_hit(parts);
  }

  void by_triangles(const PairQuery& query, const PartPair& parts, const LeastDistance* start) {
    BallPair covers;
    if (query.has_covers() && query.lower_bound(reach_, covers) >= reach_) return;
    // Where only collisions are to be decided, balls inside show most hits sooner.
    BallPair insides;
    if (options_.limit == 0 && query.has_insides() && query.upper_bound(best_.upper, insides) == 0) {
      best_.balls.inside_pair = insides;
      end_with_hit(parts);
      return;
    }
    DistanceOptions options;
    options.tolerance = options_.tolerance;
    options.limit = reach_;
    Distance before;
    if (start && parts == start->upper_pair) {
      before.triangle_a = start->triangle_a;
      before.triangle_b = start->triangle_b;
    }
    const Distance found = query.distance(options, before, stop_);
    shorten_lower(found.lower, parts, covers);
    if (found.upper < best_.upper) {
      best_.upper = found.upper;
      best_.upper_pair = parts;
      best_.triangle_a = found.triangle_a;
      best_.triangle_b = found.triangle_b;
    }
    if (found.upper == 0) end_with_hit(parts);
  }

  void shorten_lower(double lower, const PartPair& parts, const BallPair& covers) {
    if (!(lower < best_.lower)) return;
    best_.lower = lower;
    best_.lower_pair = parts;
    best_.balls.cover_pair = covers;
  }

  void end_with_hit(const PartPair& parts) {
    best_.lower = best_.upper = 0;
    best_.lower_pair = best_.upper_pair = parts;
  }

  void prove_nothing(const PartPair& parts) { shorten_lower(0, parts, {}); }

  static constexpr std::size_t kMostClose = 256;

  const BodyGroupImpl& group_;
  const Pose* poses_;
  const GroupOptions& options_;
  const std::stop_token& stop_;
  LeastDistance best_;
  double reach_;  // parts that are farther apart do not matter
  std::size_t count_ = 0;
  std::array<CloseParts, kMostClose> close_;
};

Error poses_error(std::size_t poses, std::size_t links, std::size_t configurations) {
  return {ErrorCode::kUsage,
          format_text("`poses` has {} elements for {} links in {} configurations", poses, links, configurations)};
}

Status check(const BodyGroupImpl& group, const GroupOptions& options) {
  if (!(options.tolerance >= 0 && std::isfinite(options.tolerance))) {
    return Error{ErrorCode::kUsage, "`tolerance` must be finite and not negative"};
  }
  if (!(options.limit >= 0)) return Error{ErrorCode::kUsage, "`limit` must not be negative"};
  if (!options.exact || group.has_meshes) return {};
  return Error{ErrorCode::kUsage, "`exact` needs bodies that were created with their meshes"};
}

}  // namespace

Result<LeastDistance> least_distance(const BodyGroup& group, std::span<const Pose> poses, const GroupOptions& options,
                                     const LeastDistance& start, const std::stop_token& stop) {
  const BodyGroupImpl& in_group = Internals::of(group);
  if (Status status = check(in_group, options); !status) return status.error();
  if (poses.size() != in_group.links.size()) return poses_error(poses.size(), in_group.links.size(), 1);
  try {
    return LeastSearch(in_group, poses.data(), options, stop).run(start);
  } catch (const LoopStopped&) {
    return LoopStopped::error();
  }
}

Status least_distances(const BodyGroup& group, std::span<const Pose> poses, std::span<LeastDistance> results,
                       const GroupOptions& options, const BatchOptions& batch, const std::stop_token& stop) {
  const BodyGroupImpl& in_group = Internals::of(group);
  const std::size_t links = in_group.links.size();
  if (Status status = check(in_group, options); !status) return status;
  if (poses.size() != links * results.size()) return poses_error(poses.size(), links, results.size());
  constexpr std::size_t kBlock = 64;
  try {
    parallel_blocks(results.size(), kBlock, batch.threads, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const LeastDistance start = i > begin ? results[i - 1] : LeastDistance{};
        results[i] = LeastSearch(in_group, poses.data() + i * links, options, stop).run(start);
      }
    });
  } catch (const LoopStopped&) {
    return LoopStopped::error();
  }
  return {};
}

}  // namespace medial_vk
