#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "base/point_ops.h"
#include "sphere_fits/quality/surface_samples.h"
#include "sphere_fits/steps/ball_steps.h"
#include "sphere_fits/steps/symmetric_difference.h"

namespace medial_vk {
namespace {

constexpr std::size_t kSpherePoints = 256;
constexpr double kLeastCosine =
    0.3;  // of a normal of the ball and the direction to the boundary; less is oblique, not far
constexpr double kAcross = 0.999;  // least one of a face's normal and the direction to its inner points
constexpr int kRounds = 8;
constexpr double kRidge = 1e-3;

/// The signed distance of the boundary from a sphere at one of its points, along its normal; positive: outwards.
struct Height {
  Point normal;
  double value;
};

/// Changes of centre and radius.
struct Change {
  Point move{};
  double growth = 0;
};

/// The change that leaves the least sum of |height - growth - move . normal|, by least squares whose weights are the
/// inverses of the residuals of the previous round (iteratively reweighted least squares). `unit`: a unit of length.
Change least_absolute(const std::vector<Height>& heights, double unit) {
  Eigen::Vector4d change = Eigen::Vector4d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (const Height& height : heights) {
      const Eigen::Vector4d row(height.normal[0], height.normal[1], height.normal[2], 1);
      const double rest = height.value - row.dot(change);
      const double weight = round == 0 ? 1 : 1 / std::max(std::fabs(rest) / unit, 1e-3);
      matrix += weight * row * row.transpose();
      right += weight * height.value * row;
    }
    // A few points on one side do not distinguish growth and motion; the change is then divided between them.
    matrix.diagonal().array() += kRidge * matrix(3, 3);
    change = matrix.ldlt().solve(right);
  }
  return {{change[0], change[1], change[2]}, change[3]};
}

class BalancingSteps : public BallSteps {
 public:
  BalancingSteps(const Solid& solid, const NearBoundary* bound) : solid_(solid), bound_(bound), difference_(solid) {}

  void came(const DynamicUnion& balls, std::uint32_t slot) override {
    find_others(balls, slot, 0);
    gained_ -= difference_.change(balls.ball(slot), others_);
  }

  Status replace(DynamicUnion& balls, std::uint32_t slot, const Ball& to) override {
    find_others(balls, slot,
                length(to.centre - balls.ball(slot).centre) + std::fabs(to.radius - balls.ball(slot).radius));
    gained_ -= difference_.change(balls.ball(slot), to, others_);
    return balls.shift(slot, to);
  }

  double error(const DynamicUnion& /*balls*/) const override {
    return (difference_.of_none() - gained_) / solid_.volume();
  }

 private:
  /// Balls that meet the ball, or would after such a motion; those that hold most of it first.
  void find_others(const DynamicUnion& balls, std::uint32_t slot, double reach) {
    const Ball& ball = balls.ball(slot);
    std::vector<std::pair<double, Ball>> found;
    for (std::uint32_t p = 0; p < balls.slots(); ++p) {
      if (p == slot || !balls.holds(p)) continue;
      const Ball& other = balls.ball(p);
      const double apart = length(other.centre - ball.centre) - other.radius;
      if (apart < ball.radius + reach) found.emplace_back(apart, other);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    others_.clear();
    for (const auto& [apart, other] : found) others_.push_back(other);
  }

  Result<std::optional<Ball>> propose(DynamicUnion& balls, std::uint32_t slot, double step) override {
    const Ball& ball = balls.ball(slot);
    find_others(balls, slot, 3 * step);
    heights_.clear();
    KnownHeights& known = known_heights(slot, ball);
    for (std::size_t k = 0; k < kSpherePoints; ++k) {
      const Point normal = spiral_point(k, kSpherePoints);
      const Point at = ball.centre + ball.radius * normal;
      if (is_in_other(at)) continue;
      if (std::isnan(known.heights[k])) known.heights[k] = height_at(at, normal);
      heights_.push_back({normal, known.heights[k]});
    }
    if (heights_.empty()) return std::optional<Ball>();
    const Change change = least_absolute(heights_, step);
    const double size = length(change.move) + std::fabs(change.growth);
    if (!(size > 1e-6 * step)) return std::optional<Ball>();
    const double factor = std::min(1.0, step / size);
    Ball moved = {ball.centre + factor * change.move, ball.radius + factor * change.growth};
    if (bound_ != nullptr) moved.radius = std::min(moved.radius, bound_->greatest_radius(moved.centre));
    return moved.radius > 0 ? std::optional(moved) : std::optional<Ball>();
  }

  /// Among the others that propose() has found: no step is longer than its limit there.
  Result<double> try_move(DynamicUnion& balls, std::uint32_t slot, const Ball& to) override {
    const double gain = -difference_.change(balls.ball(slot), to, others_);
    if (!(gain > 0)) return 0.0;
    if (Status status = balls.shift(slot, to); !status.ok()) return status.error();
    gained_ += gain;
    return gain;
  }

  /// Heights over the points of a sphere; NaN: not known yet.
  struct KnownHeights {
    Ball ball = {{}, -1};
    std::array<double, kSpherePoints> heights = {};
  };
  /// Most steps are refused, and the next one of the ball begins on the same sphere. A few balls take steps in turn.
  KnownHeights& known_heights(std::uint32_t slot, const Ball& ball) {
    constexpr std::size_t kBalls = 64;
    known_.resize(kBalls);
    KnownHeights& known = known_[slot % kBalls];
    if (known.ball.centre != ball.centre || known.ball.radius != ball.radius) {
      known.ball = ball;
      known.heights.fill(std::numeric_limits<double>::quiet_NaN());
    }
    return known;
  }

  bool is_in_other(const Point& at) const {
    return std::any_of(others_.begin(), others_.end(), [&](const Ball& other) {
      const Point apart = at - other.centre;
      return dot(apart, apart) < other.radius * other.radius;
    });
  }

  /// To first order: to the plane through the nearest point of the boundary.
  double height_at(const Point& at, const Point& normal) const {
    const BvhHit hit = solid_.closest(at);
    const double distance = std::sqrt(hit.squared_distance);
    if (distance <= solid_.rounding()) return 0;
    const Point towards = (1 / distance) * (hit.point - at);
    const double sign = is_inside(at, towards, hit.triangle) ? 1 : -1;
    return sign * distance / std::max(sign * dot(towards, normal), kLeastCosine);
  }

  /// Where the nearest point is not on an edge, and every face has the solid behind it, that face decides.
  bool is_inside(const Point& at, const Point& towards, std::uint32_t triangle) const {
    if (!solid_.has_volume()) return solid_.contains(at);
    const Mesh& mesh = solid_.mesh().mesh;
    const auto [a, b, c] = mesh.triangles[triangle];
    double shorter;
    const Point face = double_area(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c], shorter);
    const double cosine = dot(face, towards) / length(face);
    return std::fabs(cosine) < kAcross ? solid_.contains(at) : cosine > 0;
  }

  const Solid& solid_;
  const NearBoundary* bound_;
  SymmetricDifference difference_;
  double gained_ = 0;
  std::vector<Ball> others_;
  std::vector<Height> heights_;
  std::vector<KnownHeights> known_;
};

}  // namespace

std::unique_ptr<BallSteps> balancing_steps(const Solid& solid, const NearBoundary* bound) {
  return std::make_unique<BalancingSteps>(solid, bound);
}

}  // namespace medial_vk
