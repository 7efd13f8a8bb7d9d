#include "medial_vk/nearest_bodies.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "base/host_memory.h"
#include "proximity/body.h"
#include "proximity/neighbours/placed_bodies.h"
#include "proximity/neighbours/relative_pose.h"

namespace medial_vk {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUp = 1 + 8 * 0x1p-53, kDown = 1 - 8 * 0x1p-53;

/// The upper ends of all bodies so far, ascending.
class UpperEnds {
 public:
  void replace(double before, double after) {
    if (before < kInfinity) all_.erase(std::ranges::lower_bound(all_, before));
    if (after < kInfinity) all_.insert(std::ranges::upper_bound(all_, after), after);
  }
  /// The k-th; infinite if there are fewer.
  double at(std::size_t k) const { return k <= all_.size() ? all_[k - 1] : kInfinity; }

 private:
  std::vector<double> all_;
};

/// What is still to be looked at, the nearest first.
struct Candidate {
  enum class Kind : std::uint8_t { kNode, kBody, kBoundedBody };

  double lower = 0;  ///< No body below the node, or not this body, is nearer.
  Kind kind = Kind::kNode;
  std::uint32_t node = 0;
  NearBody body;
};

struct IsFarther {
  bool operator()(const Candidate& s, const Candidate& t) const { return s.lower > t.lower; }
};

class NearestSearch {
 public:
  NearestSearch(const Internals::ImplOf<PlacedBodies>::Type& among, const PlacedBody& query,
                const NearestBodiesOptions& options)
      : among_(among), query_(query), options_(options), has_ball_(world_ball_of(query, ball_)) {}

  Result<NearBodies> run() {
    if (!among_.tree.is_empty()) queue_.push({0, Candidate::Kind::kNode, 0, {}});
    for (const std::size_t i : among_.unknown) push_body(i, 0);
    while (!queue_.empty() && queue_.top().lower <= farthest()) {
      const Candidate candidate = queue_.top();
      queue_.pop();
      if (candidate.kind == Candidate::Kind::kNode) {
        divide(candidate);
      } else if (Status status = look_at(candidate); !status) {
        return status.error();
      }
    }
    return result();
  }

 private:
  /// Bodies that are proved to be farther away matter no longer.
  double farthest() const { return std::min(uppers_.at(options_.count), options_.limit); }

  void push_body(std::size_t index, double lower) {
    queue_.push({lower, Candidate::Kind::kBody, 0, {index, lower, kInfinity}});
  }

  /// In double, with fewer than 32 roundings of lengths that are at most their sum.
  double distance_from(const Ball& ball) const {
    if (!has_ball_) return 0;
    const Point centre = ball.centre + among_.centre;
    const double size = length(ball.centre) + length(among_.centre) + length(ball_.centre) + ball.radius + ball_.radius;
    return std::max(0.0, length(centre - ball_.centre) - ball.radius - ball_.radius - 0x1p-48 * size);
  }

  void divide(const Candidate& candidate) {
    const BodyNode& node = among_.tree.nodes().node(candidate.node);
    for (std::uint32_t k = 0; k < node.count; ++k) {
      const Point centre = {node.centre[0][k], node.centre[1][k], node.centre[2][k]};
      const double lower = std::max(candidate.lower, distance_from({centre, node.radius[k]}));
      if (node.is_lowest) {
        push_body(among_.of_ball[node.below[k]], lower);
      } else {
        queue_.push({lower, Candidate::Kind::kNode, node.below[k], {}});
      }
    }
  }

  /// Bounds by balls first, then distances by triangles; a body whose distance is known is a result.
  Status look_at(Candidate candidate) {
    const PlacedBody& other = among_.bodies[candidate.body.index];
    const RelativePose relative = relative_pose(query_.pose, other.pose, reach_of_body(other.body));
    const bool by_triangles = options_.by_triangles && query_.body.has_mesh() && other.body.has_mesh();
    const double before = candidate.body.upper;
    if (candidate.kind == Candidate::Kind::kBody) {
      const DistanceBounds bounds = distance_bounds(query_.body, other.body, relative.pose);
      narrow(candidate.body, bounds.lower, bounds.upper, relative);
    } else {
      DistanceOptions options;
      options.tolerance = options_.tolerance;
      options.limit = (farthest() + 2 * relative.length) * (1 + 4 * relative.share + 1e-12);
      const Result<Distance> found = distance(query_.body, other.body, relative.pose, options);
      if (!found) return found.error();
      narrow(candidate.body, found.value().lower, found.value().upper, relative);
    }
    uppers_.replace(before, candidate.body.upper);
    if (candidate.kind == Candidate::Kind::kBody && by_triangles) {
      candidate.kind = Candidate::Kind::kBoundedBody;
      candidate.lower = candidate.body.lower;
      queue_.push(candidate);
    } else {
      found_.push_back(candidate.body);
    }
    return {};
  }

  static void narrow(NearBody& body, double lower, double upper, const RelativePose& relative) {
    const double share = relative.share * kUp;
    const bool is_exact = relative.share == 0 && relative.length == 0;
    const double in_world_lower = is_exact ? lower : (lower * (1 - share) - relative.length) * kDown;
    const double in_world_upper = is_exact ? upper : (upper * (1 + share) + relative.length) * kUp;
    body.lower = std::max(body.lower, in_world_lower);
    body.upper = std::max(body.lower, std::min(body.upper, in_world_upper));
  }

  NearBodies result() {
    NearBodies result;
    const double farthest_of_all = farthest();
    if (!queue_.empty()) result.others = queue_.top().lower;
    for (const NearBody& body : found_) {
      if (body.lower <= farthest_of_all) {
        result.bodies.push_back(body);
      } else {
        result.others = std::min(result.others, body.lower);
      }
    }
    std::ranges::sort(result.bodies, [](const NearBody& s, const NearBody& t) {
      return s.upper != t.upper ? s.upper < t.upper : s.index < t.index;
    });
    return result;
  }

  const Internals::ImplOf<PlacedBodies>::Type& among_;
  const PlacedBody& query_;
  const NearestBodiesOptions& options_;
  Ball ball_;
  bool has_ball_;
  UpperEnds uppers_;
  std::vector<NearBody> found_;
  std::priority_queue<Candidate, std::vector<Candidate>, IsFarther> queue_;
};

Status check(const NearestBodiesOptions& options) {
  if (options.count < 1) return Error{ErrorCode::kUsage, "`count` must be at least 1"};
  if (!(options.limit >= 0)) return Error{ErrorCode::kUsage, "`limit` must not be negative"};
  if (!(options.tolerance >= 0 && std::isfinite(options.tolerance))) {
    return Error{ErrorCode::kUsage, "`tolerance` must be finite and not negative"};
  }
  return {};
}

}  // namespace

Result<NearBodies> nearest_bodies(const PlacedBodies& among, const Body& body, const Pose& pose,
                                  const NearestBodiesOptions& options) {
  if (Status status = check(options); !status) return status.error();
  if (Status status = check_world_pose(pose, "the body"); !status) return status.error();
  return catch_out_of_memory("searching the nearest bodies", [&] {
    const PlacedBody query = {body, pose};
    return NearestSearch(Internals::of(among), query, options).run();
  });
}

}  // namespace medial_vk
