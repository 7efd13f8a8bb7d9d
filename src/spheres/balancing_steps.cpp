#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "mesh/point_ops.h"
#include "spheres/ball_steps.h"
#include "spheres/surface_samples.h"
#include "spheres/symmetric_difference.h"

namespace medial_vk {
namespace {

constexpr std::size_t kSpherePoints = 256;
constexpr double kLeastCosine = 0.3;  // of a normal of the ball and the way to the boundary: that is oblique, not far
constexpr double kAcross = 0.999;     // of a face's normal and the way to its inner points, at least
constexpr int kRounds = 8;
constexpr double kRidge = 1e-3;

/// How far the boundary is from a sphere at one of its points, along its normal; positive: outwards.
struct Height {
  Point normal;
  double value;
};

/// Centre and radius change by these.
struct Change {
  Point move{};
  double growth = 0;
};

using Row = std::array<double, 5>;  // of four equations, with the right side

/// The solution of a positive definite system.
std::array<double, 4> solve(std::array<Row, 4> rows) {
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = k + 1; i < 4; ++i) {
      const double factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < 5; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  std::array<double, 4> x{};
  for (std::size_t k = 4; k-- > 0;) {
    double sum = rows[k][4];
    for (std::size_t j = k + 1; j < 4; ++j) sum -= rows[k][j] * x[j];
    x[k] = sum / rows[k][k];
  }
  return x;
}

/// The change that leaves the least sum of |height - growth - move . normal|, by least squares whose weights are the
/// inverses of what the round before has left (iteratively reweighted least squares). `unit`: of a length.
Change least_absolute(const std::vector<Height>& heights, double unit) {
  Change change;
  for (int round = 0; round < kRounds; ++round) {
    std::array<Row, 4> rows{};
    for (const Height& height : heights) {
      const double rest = height.value - change.growth - dot(change.move, height.normal);
      const double weight = round == 0 ? 1 : 1 / std::max(std::fabs(rest) / unit, 1e-3);
      const std::array<double, 4> row = {height.normal[0], height.normal[1], height.normal[2], 1};
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) rows[i][j] += weight * row[i] * row[j];
        rows[i][4] += weight * row[i] * height.value;
      }
    }
    // What a few points on one side do not tell apart, growing and moving, is shared among them.
    for (std::size_t i = 0; i < 4; ++i) rows[i][i] += kRidge * rows[3][3];
    const std::array<double, 4> x = solve(rows);
    change = {{x[0], x[1], x[2]}, x[3]};
  }
  return change;
}

class BalancingSteps : public BallSteps {
 public:
  explicit BalancingSteps(const Solid& solid) : solid_(solid), difference_(solid) {}

  Result<double> take(DynamicUnion& balls, std::uint32_t place, double& step) override {
    const Ball ball = balls.ball(place);
    if (step < kShortestStep * ball.radius) return 0.0;
    find_others(balls, place, 3 * step);
    const std::optional<Ball> moved = propose(ball, step);
    if (!moved) {
      step /= 4;
      return 0.0;
    }
    const double gain = difference_.change(ball, others_) - difference_.change(*moved, others_);
    if (!(gain > 0)) {
      step /= 2;
      return 0.0;
    }
    if (Status status = balls.move(place, *moved); !status.ok()) return status.error();
    gained_ += gain;
    step = std::min(1.3 * step, kLongestStep * moved->radius);
    return gain;
  }

  void came(const DynamicUnion& balls, std::uint32_t place) override {
    find_others(balls, place, 0);
    gained_ -= difference_.change(balls.ball(place), others_);
  }

  double error(const DynamicUnion& /*balls*/) const override {
    return (difference_.of_none() - gained_) / solid_.volume();
  }

 private:
  /// Those that meet the ball, or would if it moved so far; those that hold most of it first.
  void find_others(const DynamicUnion& balls, std::uint32_t place, double reach) {
    const Ball& ball = balls.ball(place);
    std::vector<std::pair<double, Ball>> found;
    for (std::uint32_t p = 0; p < balls.places(); ++p) {
      if (p == place || !balls.holds(p)) continue;
      const Ball& other = balls.ball(p);
      const double apart = length(other.centre - ball.centre) - other.radius;
      if (apart < ball.radius + reach) found.emplace_back(apart, other);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    others_.clear();
    for (const auto& [apart, other] : found) others_.push_back(other);
  }

  std::optional<Ball> propose(const Ball& ball, double step) {
    heights_.clear();
    for (std::size_t k = 0; k < kSpherePoints; ++k) {
      const Point normal = spiral_point(k, kSpherePoints);
      const Point at = ball.centre + ball.radius * normal;
      if (is_in_other(at)) continue;
      heights_.push_back({normal, height_at(at, normal)});
    }
    if (heights_.empty()) return std::nullopt;
    Change change = least_absolute(heights_, step);
    const double size = length(change.move) + std::fabs(change.growth);
    if (!(size > 1e-6 * step)) return std::nullopt;
    const double factor = std::min(1.0, step / size);
    const Ball moved = {ball.centre + factor * change.move, ball.radius + factor * change.growth};
    return moved.radius > 0 ? std::optional(moved) : std::nullopt;
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

  /// Where the nearest point is no edge's, and every face has the solid behind it, that face knows.
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
  SymmetricDifference difference_;
  double gained_ = 0;
  std::vector<Ball> others_;
  std::vector<Height> heights_;
};

}  // namespace

std::unique_ptr<BallSteps> balancing_steps(const Solid& solid) { return std::make_unique<BalancingSteps>(solid); }

}  // namespace medial_vk
