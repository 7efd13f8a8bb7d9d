#include "gradient_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "base/split_mix.h"
#include "k_means.h"
#include "samples.h"
#include "sphere_fits/quality/nearest_ball_tree.h"

namespace medial_vk::bench {
namespace {

constexpr unsigned kDensityInterval = 100, kFirstIterations = 10;
constexpr double kLeastRadius = 0.1, kLeastGap = 0.1;  // of the mean radius
constexpr double kRadiusSpread = 0.1;                  // of the logarithms of first radii
constexpr double kLastStep = 0.01;                     // share of the first one
constexpr std::size_t kNumbers = 4;                    // of a ball: its centre and its radius

using BallGradient = std::array<double, kNumbers>;

/// Adds factor * (direction, 1 for the radius times `of_radius`).
void add_to(BallGradient& gradient, double factor, const Point& direction, double of_radius) {
  for (std::size_t k = 0; k < 3; ++k) gradient[k] += factor * direction[k];
  gradient[3] += factor * of_radius;
}

Point unit_or_zero(const Point& p) {
  const double size = length(p);
  return size > 0 ? (1 / size) * p : Point{0, 0, 0};
}

class Descent {
 public:
  Descent(const Solid& solid, const GradientFitOptions& options)
      : solid_(solid),
        options_(options),
        diagonal_(solid.diagonal()),
        mean_radius_(std::cbrt(3 * solid.volume() / (4 * std::numbers::pi * static_cast<double>(options.count)))),
        inside_(points_inside(solid, options.inside_points, options.seed, options.threads)),
        boundary_(points_of_boundary(solid, options.boundary_points)) {
    start();
  }

  std::vector<Ball> run() {
    for (unsigned step = 1; step <= options_.steps; ++step) {
      find_gradient();
      move(step);
      if (step % kDensityInterval != 0) continue;
      prune();
      if (step < options_.steps) densify();
    }
    return balls_;
  }

 private:
  void start() {
    SplitMix random(options_.seed + 1);
    KMeansOptions clusters;
    clusters.count = options_.count;
    clusters.iterations = kFirstIterations;
    clusters.seed = options_.seed;
    clusters.threads = options_.threads;
    for (const Point& centre : k_means(solid_, clusters)) {
      const double chance = 1 - 0.5 * (random.symmetric() + 1);  // in (0, 1]
      const double angle = std::numbers::pi * random.symmetric();
      const double normal = std::sqrt(-2 * std::log(chance)) * std::cos(angle);  // Box and Muller 1958
      balls_.push_back({centre, mean_radius_ * std::exp(kRadiusSpread * normal)});
    }
    forget_moments();
  }

  void find_gradient() {
    gradients_.assign(balls_.size(), BallGradient{});
    const NearestBallTree tree(balls_);
    add_coverage(tree);
    add_surface(tree);
    add_overlap();
    add_depths();
  }

  template <class Points, class At>
  void find_nearest(const NearestBallTree& tree, const Points& points, const At& at) {
    nearest_.resize(points.size());
    parallel_for(points.size(), 128, options_.threads,
                 [&](std::size_t i) { nearest_[i] = tree.nearest(at(points[i])); });
  }

  void add_coverage(const NearestBallTree& tree) {
    find_nearest(tree, inside_, [](const Point& p) -> const Point& { return p; });
    const double factor = options_.weights.coverage / static_cast<double>(inside_.size());
    for (std::size_t i = 0; i < inside_.size(); ++i) {
      const auto [distance, ball] = nearest_[i];
      if (distance <= 0) continue;
      add_to(gradients_[ball], -factor, unit_or_zero(inside_[i] - balls_[ball].centre), 1);
    }
  }

  void add_surface(const NearestBallTree& tree) {
    find_nearest(tree, boundary_, [](const SurfacePoint& p) -> const Point& { return p.at; });
    const double share = 1 / static_cast<double>(boundary_.size());
    for (std::size_t i = 0; i < boundary_.size(); ++i) {
      const auto [distance, index] = nearest_[i];
      const Ball& ball = balls_[index];
      const Point across = boundary_[i].at - ball.centre;
      const double sign = distance > 0 ? 1 : -1;
      add_to(gradients_[index], -share * options_.weights.surface * sign, unit_or_zero(across), 1);
      const double quadric = (dot(boundary_[i].normal, across) - ball.radius) / diagonal_;
      add_to(gradients_[index], -2 * share * options_.weights.sqem * quadric, boundary_[i].normal, 1);
    }
  }

  void add_overlap() {
    const auto number = static_cast<double>(balls_.size());
    const double factor = options_.weights.overlap / std::max(1.0, 0.5 * number * (number - 1));
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      for (std::size_t j = i + 1; j < balls_.size(); ++j) {
        const Point across = balls_[i].centre - balls_[j].centre;
        const double overlap = balls_[i].radius + balls_[j].radius - length(across);
        if (overlap <= 0) continue;
        const Point direction = unit_or_zero(across);
        add_to(gradients_[i], factor, -1.0 * direction, 1);
        add_to(gradients_[j], factor, direction, 1);
      }
    }
  }

  void add_depths() {
    const double share = 1 / static_cast<double>(balls_.size());
    parallel_for(balls_.size(), 8, options_.threads, [&](std::size_t i) {
      const auto [depth, gradient] = depth_of(solid_, balls_[i].centre);
      const double out = balls_[i].radius - depth;
      if (out > 0) add_to(gradients_[i], share * options_.weights.boundary, -1.0 * gradient, 1);
      if (depth < 0) add_to(gradients_[i], -share * options_.weights.containment, gradient, 0);
    });
  }

  void forget_moments() {
    first_.assign(balls_.size(), BallGradient{});
    second_.assign(balls_.size(), BallGradient{});
    since_ = 0;
  }

  /// A step of Adam with its usual constants.
  void move(unsigned step) {
    constexpr double kFirst = 0.9, kSecond = 0.999, kTiny = 1e-12;
    ++since_;
    const double done = static_cast<double>(step - 1) / static_cast<double>(options_.steps);
    const double share = kLastStep + (1 - kLastStep) * 0.5 * (1 + std::cos(std::numbers::pi * done));
    const double size = options_.step * mean_radius_ * share;
    const double first_bias = 1 - std::pow(kFirst, since_), second_bias = 1 - std::pow(kSecond, since_);
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      for (std::size_t k = 0; k < kNumbers; ++k) {
        const double slope = gradients_[i][k];
        first_[i][k] = kFirst * first_[i][k] + (1 - kFirst) * slope;
        second_[i][k] = kSecond * second_[i][k] + (1 - kSecond) * slope * slope;
        const double change = size * (first_[i][k] / first_bias) / (std::sqrt(second_[i][k] / second_bias) + kTiny);
        double& number = k < 3 ? balls_[i].centre[k] : balls_[i].radius;
        number -= change;
      }
      balls_[i].radius = std::max(balls_[i].radius, 1e-6 * diagonal_);
    }
  }

  void prune() {
    const double least = kLeastRadius * mean_radius_;
    std::vector<Ball> kept;
    for (const Ball& ball : balls_) {
      if (ball.radius >= least) kept.push_back(ball);
    }
    // A set of small balls alone is left as it is.
    if (kept.empty() || kept.size() == balls_.size()) return;
    balls_ = std::move(kept);
    forget_moments();
  }

  void densify() {
    const std::size_t before = balls_.size();
    std::vector<double> gaps(inside_.size());
    const NearestBallTree tree(balls_);
    parallel_for(inside_.size(), 128, options_.threads,
                 [&](std::size_t i) { gaps[i] = tree.nearest(inside_[i]).distance; });
    while (balls_.size() < options_.count) {
      const auto worst = static_cast<std::size_t>(std::max_element(gaps.begin(), gaps.end()) - gaps.begin());
      if (gaps[worst] <= kLeastGap * mean_radius_) break;
      const Ball added = {inside_[worst], gaps[worst]};
      balls_.push_back(added);
      for (std::size_t i = 0; i < inside_.size(); ++i) {
        gaps[i] = std::min(gaps[i], length(inside_[i] - added.centre) - added.radius);
      }
    }
    if (balls_.size() > before) forget_moments();
  }

  const Solid& solid_;
  const GradientFitOptions options_;
  double diagonal_;
  double mean_radius_;  // of `count` balls with the volume of the solid together
  std::vector<Point> inside_;
  std::vector<SurfacePoint> boundary_;
  std::vector<Ball> balls_;
  std::vector<BallGradient> gradients_, first_, second_;
  std::vector<NearestBall> nearest_;
  unsigned since_ = 0;  // steps since the moments began
};

}  // namespace

std::vector<Ball> gradient_fit(const Solid& solid, const GradientFitOptions& options) {
  return Descent(solid, options).run();
}

}  // namespace medial_vk::bench
