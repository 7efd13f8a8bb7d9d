#include "proximity/nearest_triangles.h"

#include <algorithm>
#include <limits>

#include "base/loop_watch.h"

namespace medial_vk {
namespace {

/// Let S bound the sum of the greatest distances of corners of both triangles, and of the shift, from the origins of
/// their frames; u = 2^-53. A corner in the other frame has in each coordinate an error of 4 u times a sum of absolute
/// values, and so one of less than 7 u S. A point between corners has one of 6 u S more, a difference of points u S,
/// its length 4 u S, a product with a unit vector 4 u S, and that vector 4 u S: less than 32 u S in all.
constexpr double kRounding = 32 * 0x1p-53;

constexpr std::size_t kWidth = BodyNode::kWidth;

/// A direction across which triangles may be separated: by two planes, one behind the triangle of a and one before that
/// of b. In the frames of the meshes and, in float, of the trees.
class Planes {
 public:
  Planes() = default;
  Planes(const Point& direction, const Pose& pose, const Point& shift_of_trees) : of_a_(direction) {
    for (std::size_t j = 0; j < 3; ++j) {
      const auto& r = pose.rotation;
      of_b_[j] = r[0][j] * direction[0] + r[1][j] * direction[1] + r[2][j] * direction[2];
      float_of_a_[j] = static_cast<float>(of_a_[j]);
      float_of_b_[j] = static_cast<float>(of_b_[j]);
    }
    shift_ = dot(pose.shift, direction);
    shift_of_trees_ = dot(shift_of_trees, direction);
  }

  /// A lower bound of the distance between a triangle of a and one of b, each in its own frame.
  double apart(const Corners& a, const Corners& b) const {
    const double end = std::max({dot(a[0], of_a_), dot(a[1], of_a_), dot(a[2], of_a_)});
    const double start = std::min({dot(b[0], of_b_), dot(b[1], of_b_), dot(b[2], of_b_)});
    return (start + shift_) - end;
  }

  /// How far eight triangles of a, or what eight boxes hold, reach along the direction.
  MEDIAL_VK_INLINE EightFloats end_of(const SurfaceTree::EightTriangles& a) const {
    EightFloats end = along(a[0], float_of_a_);
    for (std::size_t corner = 1; corner < 3; ++corner) end = greater(along(a[corner], float_of_a_), end);
    return end;
  }
  MEDIAL_VK_INLINE EightFloats end_of(const EightBoxes& a) const {
    return along(a.centre, float_of_a_) + half_width(a, float_of_a_);
  }

  /// Where those of b begin.
  MEDIAL_VK_INLINE EightFloats start_of(const SurfaceTree::EightTriangles& b) const {
    EightFloats start = along(b[0], float_of_b_);
    for (std::size_t corner = 1; corner < 3; ++corner) start = lesser(along(b[corner], float_of_b_), start);
    return start;
  }
  MEDIAL_VK_INLINE EightFloats start_of(const EightBoxes& b) const {
    return along(b.centre, float_of_b_) - half_width(b, float_of_b_);
  }

  /// How far behind the end of a, in the frames of the trees, b begins where the two are apart by `reach`. For bodies
  /// that are far from each other the reach and the shift are large and nearly equal, so the difference is one of
  /// doubles.
  float without_shift(double reach) const { return rounded_up(reach - shift_of_trees_); }

  /// Bit 8 k + j is set unless element j of b begins behind element k of a by at least `reach`, without the shift.
  MEDIAL_VK_INLINE static std::uint64_t pairs_within(const EightFloats& end, const EightFloats& start, float reach) {
    const EightFloats nearer = end + reach;
    const std::array<float, kWidth> starts = stored(start);
    EightInts pairs{};
    for (std::size_t j = 0; j < kWidth; ++j) pairs |= (starts[j] < nearer) & (std::int32_t{1} << j);
    return bytes_of(pairs);
  }

 private:
  MEDIAL_VK_INLINE static EightFloats along(const std::array<std::array<float, kWidth>, 3>& points,
                                            const std::array<float, 3>& d) {
    return load(points[0]) * d[0] + load(points[1]) * d[1] + load(points[2]) * d[2];
  }

  MEDIAL_VK_INLINE static EightFloats half_width(const EightBoxes& boxes, const std::array<float, 3>& d) {
    return absolute(along(boxes.half_edges[0], d)) + absolute(along(boxes.half_edges[1], d)) +
           absolute(along(boxes.half_edges[2], d));
  }

  Point of_a_ = {0, 0, 0}, of_b_ = {0, 0, 0};
  std::array<float, 3> float_of_a_ = {0, 0, 0}, float_of_b_ = {0, 0, 0};
  double shift_ = 0, shift_of_trees_ = 0;
};

FloatBall ball_of(const BodyNode& node, std::uint32_t k) {
  return {{node.centre[0][k], node.centre[1][k], node.centre[2][k]}, node.radius[k], node.excess[k]};
}

class TrianglesGoal {
 public:
  TrianglesGoal(const SurfaceTree& a, const SurfaceTree& b, const Placement& placement, const DistanceOptions& options,
                const std::stop_token& stop)
      : a_(a),
        b_(b),
        placement_(placement),
        options_(options),
        stop_(stop),
        float_error_(placement.separation_error_of(a.nodes(), b.nodes())),
        error_(kRounding * (placement.lengths() + a.nodes().reach() + b.nodes().reach())) {
    shorten();
  }

  float reach() const { return reach_; }
  /// Asked before every comparison, and so the place to stop.
  bool is_reached() const {
    if (stop_.stop_requested()) throw LoopStopped();
    return best_.upper == 0;
  }

  /// The solids are no farther apart than balls in them. Neither are their surfaces, unless one solid lies in the
  /// other. (Every way from one solid to another one meets both surfaces.)
  MEDIAL_VK_INLINE void see(float separation, const BallsOfNodes& balls) {
    const float most = separation + (balls.a->excess[balls.k] + balls.b->excess[balls.j]);
    if (most < between_inner_balls_) shorten(most, balls);
  }

  /// Bit 8 k + j: what ball k of a node of a and ball j of one of b hold may be closer than the target.
  MEDIAL_VK_INLINE std::uint64_t pairs_of(std::uint32_t node_a, std::uint32_t node_b) const {
    if (count_ == 0) return ~std::uint64_t{0};
    const bool is_lowest_a = a_.nodes().node(node_a).is_lowest, is_lowest_b = b_.nodes().node(node_b).is_lowest;
    if (is_lowest_a && is_lowest_b && are_apart(node_a, node_b)) return 0;
    std::uint64_t pairs = ~std::uint64_t{0};
    for (std::size_t i = 0; i < count_ && pairs != 0; ++i) {
      const Planes& planes = planes_[i];
      const EightFloats end = is_lowest_a ? planes.end_of(a_.triangles(node_a)) : planes.end_of(a_.boxes(node_a));
      const EightFloats start = is_lowest_b ? planes.start_of(b_.triangles(node_b)) : planes.start_of(b_.boxes(node_b));
      pairs &= Planes::pairs_within(end, start, reach_by_planes_[i]);
    }
    return pairs;
  }

  bool take(const CloseItems& items) {
    const Corners of_a = a_.corners(items.a), of_b = b_.corners(items.b);
    // Nearly all neighbours of the nearest two triangles lie behind the planes that separate these two.
    for (std::size_t i = 0; i < count_; ++i) {
      const double apart = planes_[i].apart(of_a, of_b) - error_;
      if (apart < target_) continue;
      proved_ = std::min(proved_, apart);
      return false;
    }
    test(items, of_a, in_frame_of_a(of_b));
    return true;
  }

  /// All pairs of triangles that were tested are at least `proved_` apart, those that were passed over at least the
  /// target of that time, which was no less than now, and the others what their balls are. What was proved once holds.
  void wait(float separation) {
    waiting_ = separation < kFarther ? separation - float_error_ : std::numeric_limits<double>::infinity();
    proved_before_ = std::max(proved_before_, proved_now());
  }

  Distance result() const {
    Distance result = best_;
    result.lower = result.upper == 0 ? 0 : std::max({0.0, proved_before_, proved_now()});
    return result;
  }

 private:
  static constexpr std::size_t kMostPlanes = 2;  // more take longer than they save

  /// How far all triangles of a node reach along the first direction, or against it.
  struct Support {
    std::uint32_t node = ~std::uint32_t{0};
    std::uint32_t direction = 0;  // counts the first directions there have been
    float value = 0;

    bool is_of(std::uint32_t of_node, std::uint32_t along) const { return node == of_node && direction == along; }
  };
  static constexpr std::size_t kSupports = 64;

  /// Two nodes of the lowest level, by the first planes. A node is compared with many, so what is computed for it is
  /// kept, until another one takes its place.
  MEDIAL_VK_INLINE bool are_apart(std::uint32_t node_a, std::uint32_t node_b) const {
    Support &of_a = ends_[node_a % kSupports], &of_b = starts_[node_b % kSupports];
    if (!of_a.is_of(node_a, directions_)) {
      of_a = {node_a, directions_, greatest_of(planes_[0].end_of(a_.triangles(node_a)))};
    }
    if (!of_b.is_of(node_b, directions_)) {
      of_b = {node_b, directions_, -greatest_of(-planes_[0].start_of(b_.triangles(node_b)))};
    }
    return of_b.value >= of_a.value + reach_by_planes_[0];
  }

  double proved_now() const { return std::min({proved_, target_, waiting_}); }

  Corners in_frame_of_a(const Corners& corners) const {
    const Pose& pose = placement_.pose();
    return {pose * corners[0], pose * corners[1], pose * corners[2]};
  }

  void shorten(float most, const BallsOfNodes& balls) {
    if (options_.surfaces_only) return;
    between_inner_balls_ = most;
    if (most < -2 * float_error_) {  // two sums more than a separation
      best_.lower = best_.upper = 0;
      best_.on_a = best_.on_b = point_of_both(balls);
    }
    shorten();
  }

  /// A point of one solid in the inner ball of the other one, or, of two inner balls that overlap by more than all
  /// errors, the point that divides the way between their centres by their radii.
  Point point_of_both(const BallsOfNodes& balls) const {
    const FloatBall a = ball_of(*balls.a, balls.k), b = ball_of(*balls.b, balls.j);
    const double depth_a = a.radius - a.excess, depth_b = b.radius - b.excess;
    if (depth_a < 0) return some_corner(a_, *balls.a, balls.k);
    if (depth_b < 0) return placement_.pose() * some_corner(b_, *balls.b, balls.j);
    const Point centre_a = point_of(a) + placement_.centre_a();
    const Point centre_b = placement_.pose() * (point_of(b) + placement_.centre_b());
    return centre_a + depth_a / (depth_a + depth_b) * (centre_b - centre_a);
  }

  static Point some_corner(const SurfaceTree& tree, const BodyNode& node, std::uint32_t slot) {
    const BodyNode* above = &node;
    std::uint32_t below = node.below[slot];
    for (; !above->is_lowest; below = above->below[0]) above = &tree.nodes().node(below);
    return tree.corners(below)[0];
  }

  void test(const CloseItems& items, const Corners& of_a, const Corners& of_b) {
    const TrianglePoints points = nearest_points(of_a, of_b, error_);
    if (points.crosses) {
      best_ = {0, 0, points.on_a, points.on_b, items.a, items.b};
      return;
    }
    proved_ = std::min(proved_, points.apart - error_);
    const bool is_best = points.distance + error_ < best_.upper;
    if (points.apart > 0) keep(points.direction, is_best);
    if (!is_best) return;
    best_ = {0, points.distance + error_, points.on_a, points.on_b, items.a, items.b};
    shorten();
  }

  /// The planes of the nearest two triangles are the first; the others are those before, or of a later pair.
  void keep(const Point& direction, bool is_best) {
    const Planes planes(direction, placement_.pose(), placement_.shift());
    if (count_ < kMostPlanes) ++count_;
    if (!is_best && count_ > 1) {
      planes_[1] = planes;
    } else {
      planes_[1] = planes_[0];
      planes_[0] = planes;
      ++directions_;
    }
    shorten_by_planes();
  }

  /// Let R be the sum of both reaches and u = 2^-24. A corner has an error of u R, and so has a direction; a product
  /// with it 4 u R more: 12 u R for both sides, and less than 22 u R with boxes (docs/theory.md, "Exact distances").
  /// What remains of the target without the shift is rounded once, and a sum with it: 7 u R if it is below 3 R.
  /// Otherwise it decides by itself.
  void shorten_by_planes() {
    const double reach = a_.nodes().reach() + b_.nodes().reach();
    const double error = 36 * 0x1p-24 * reach + 0x1p-59 + 0x1p-48 * (placement_.lengths() + placement_.distance());
    for (std::size_t i = 0; i < count_; ++i) reach_by_planes_[i] = planes_[i].without_shift(target_ + error);
  }

  /// Pairs at `target_` and beyond no longer matter: the nearest two triangles are not among them, or the interval is
  /// narrow enough. The many pairs that share the nearest edge or corner are at the least distance up to rounding,
  /// and so beyond as well.
  void shorten() {
    const double limit = options_.limit + 8 * error_;
    // No shorter than errors: triangles are to decide whether the solids touch.
    const double most = std::max(between_inner_balls_ + 2 * float_error_, 4 * float_error_);
    target_ = std::min({best_.upper - options_.tolerance, most, limit}) - 4 * error_;
    reach_ = std::min(kFarther, rounded_up(target_ + float_error_));
    shorten_by_planes();
  }

  const SurfaceTree& a_;
  const SurfaceTree& b_;
  const Placement& placement_;
  const DistanceOptions& options_;
  const std::stop_token& stop_;
  double float_error_;  // of a computed separation of balls
  double error_;        // of a corner, a point between corners, a distance between such points, and a separation
  Distance best_;
  double target_ = 0;
  double proved_ = std::numeric_limits<double>::infinity();   // no pair that was taken is closer
  double waiting_ = std::numeric_limits<double>::infinity();  // no pair that waits is closer
  double proved_before_ = 0;                                  // no pair at all is closer
  float reach_ = 0;
  float between_inner_balls_ = kFarther;  // the distance of the solids is at most this and two errors
  std::size_t count_ = 0;
  std::array<Planes, kMostPlanes> planes_;
  std::array<float, kMostPlanes> reach_by_planes_ = {};  // without the shift
  mutable std::array<Support, kSupports> ends_, starts_;
  std::uint32_t directions_ = 0;
};

}  // namespace

Distance nearest_triangles(const SurfaceTree& a, const SurfaceTree& b, const Placement& placement,
                           const Distance& start, const DistanceOptions& options, const std::stop_token& stop) {
  TrianglesGoal goal(a, b, placement, options, stop);
  const bool has_start = start.triangle_a < a.size() && start.triangle_b < b.size();
  if (has_start) goal.take({0, start.triangle_a, start.triangle_b});
  TreeSearch search(a.nodes(), b.nodes(), placement.float_pose(), goal);
  const auto run = [&]() __attribute__((always_inline)) {
    if (!has_start) {
      search.template dive<true>();  // where solids are thin, the better way
      search.dive();
    }
    if (options.most_comparisons == DistanceOptions().most_comparisons) {
      search.run();
    } else {
      search.run(options.most_comparisons);
    }
  };
  run_on_this_processor(run);
  return goal.result();
}

}  // namespace medial_vk
