#include "cpu_reference/hull_certificate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "cpu_reference/queries.h"

namespace medial_vk::reference {
namespace {

using Eigen::Vector3d;

constexpr int kRandomBalls = 256;  // of a hull
constexpr int kBallsInside = 16;   // of these: with a winding number
// Golden sections of an edge: each leaves 0.618 of it, so that 2^-52 of it are left.
constexpr int kSections = 76;

/// One condition about hulls: records the count, the least margin and the first failure.
class HullRow {
 public:
  HullRow(std::string condition, std::string unit) {
    line_.condition = std::move(condition);
    line_.unit = std::move(unit);
    line_.worst = std::numeric_limits<double>::infinity();
  }

  /// Negative margins, and nan, fail.
  void test(double margin, std::size_t hull, const Vector3d& at) {
    ++line_.tested;
    if (!(margin >= line_.worst)) line_.worst = margin;
    if (margin >= 0 || line_.failed++ > 0) return;
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "hull %zu at (%.9g, %.9g, %.9g)", hull + 1, at.x(), at.y(), at.z());
    line_.first_failure = text.data();
  }

  CertificateLine line() const {
    CertificateLine copy = line_;
    if (copy.tested == 0) copy.worst = 0;
    return copy;
  }

 private:
  CertificateLine line_;
};

UnionBall between(const UnionBall& a, const UnionBall& b, double share) {
  return {(1 - share) * a.centre + share * b.centre, (1 - share) * a.radius + share * b.radius};
}

class HullCheck {
 public:
  explicit HullCheck(const Mesh& mesh) : tree_(mesh) {}

  void test(const Hull& hull, std::size_t number) {
    if (!is_valid(hull, number)) return;
    // A ball of given weights is a sum of three products in each coordinate and in the radius: with at most 8 roundings
    // each of 2^-53 of the greatest coordinate or radius it moves, and grows, by less than 32 of them. Distances have
    // the bound of the tree.
    double greatest = 0;
    for (const UnionBall& ball : hull.balls) {
      greatest = std::max({greatest, ball.centre.cwiseAbs().maxCoeff(), ball.radius});
    }
    room_ = 32 * 0x1p-53 * greatest + tree_.rounding();
    random_balls(hull, number);
    const std::size_t balls = hull.balls.size();
    for (std::size_t i = 0; i < balls; ++i) {
      for (std::size_t j = i + 1; j < balls; ++j) edge(hull.balls[i], hull.balls[j], number);
    }
  }

  Certificate rows() const { return {{valid_.line(), inside_.line(), below_.line(), edges_.line()}}; }

 private:
  bool is_valid(const Hull& hull, std::size_t number) {
    bool is_good = !hull.balls.empty() && hull.balls.size() <= 3;
    for (const UnionBall& ball : hull.balls) {
      is_good = is_good && ball.centre.allFinite() && std::isfinite(ball.radius) && ball.radius >= 0;
    }
    valid_.test(is_good ? 0 : -1, number, hull.balls.empty() ? Vector3d::Zero() : hull.balls[0].centre);
    return is_good;
  }

  void test_ball(const UnionBall& ball, std::size_t number, bool with_side) {
    if (with_side) inside_.test(is_inside(tree_, ball.centre) ? 0 : -1, number, ball.centre);
    below_.test(tree_.closest(ball.centre).distance + room_ - ball.radius, number, ball.centre);
  }

  /// The balls at the corners, and others of weights that are uniform over the simplex.
  void random_balls(const Hull& hull, std::size_t number) {
    for (const UnionBall& ball : hull.balls) test_ball(ball, number, true);
    if (hull.balls.size() == 1) return;
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < kRandomBalls; ++i) {
      double u = uniform(random_), v = 0;
      if (hull.balls.size() == 3) {
        v = uniform(random_);
        if (u + v > 1) u = 1 - u, v = 1 - v;
      }
      UnionBall ball = {(1 - u - v) * hull.balls[0].centre + u * hull.balls[1].centre,
                        (1 - u - v) * hull.balls[0].radius + u * hull.balls[1].radius};
      if (hull.balls.size() == 3) {
        ball.centre += v * hull.balls[2].centre;
        ball.radius += v * hull.balls[2].radius;
      }
      test_ball(ball, number, i < kBallsInside);
    }
  }

  /// The margin of the ball at a share of an edge from one triangle, a convex function of the share: the distance to a
  /// convex set less a linear function.
  double margin_from(int triangle, const UnionBall& a, const UnionBall& b, double share) const {
    const UnionBall ball = between(a, b, share);
    return std::sqrt(tree_.closest_on(triangle, ball.centre).squared_distance) - ball.radius;
  }

  void edge(const UnionBall& a, const UnionBall& b, std::size_t number) {
    const double reach = ((a.centre - b.centre).norm() + std::abs(a.radius - b.radius)) / 2;
    double worst = std::min(tree_.closest(a.centre).distance - a.radius, tree_.closest(b.centre).distance - b.radius);
    Vector3d at = a.centre;
    for (int t = 0; t < tree_.triangle_count(); ++t) {
      // Along half of the edge the margin changes by no more than `reach`.
      if (margin_from(t, a, b, 0.5) - reach >= worst) continue;
      const double share = least_share(t, a, b);
      const double margin = margin_from(t, a, b, share);
      if (margin >= worst) continue;
      worst = margin;
      at = between(a, b, share).centre;
    }
    edges_.test(worst + room_, number, at);
  }

  /// Where the margin is least, by golden sections.
  double least_share(int t, const UnionBall& a, const UnionBall& b) const {
    constexpr double kGolden = 0.6180339887498949;
    double low = 0, high = 1;
    double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    double at_left = margin_from(t, a, b, left), at_right = margin_from(t, a, b, right);
    for (int i = 0; i < kSections; ++i) {
      if (at_left <= at_right) {
        high = right;
        right = left, at_right = at_left;
        left = high - kGolden * (high - low);
        at_left = margin_from(t, a, b, left);
      } else {
        low = left;
        left = right, at_left = at_right;
        right = low + kGolden * (high - low);
        at_right = margin_from(t, a, b, right);
      }
    }
    return at_left <= at_right ? left : right;
  }

  const Tree tree_;
  double room_ = 0;
  std::mt19937_64 random_{1};
  HullRow valid_{"one to three balls with finite numbers", "of 1"};
  HullRow inside_{"centres inside (winding number at least 1/2)", "of 1"};
  HullRow below_{"random balls of each hull: radius <= exact distance", "length"};
  HullRow edges_{"along every edge: radius <= distance to every triangle", "length"};
};

}  // namespace

Certificate check_hulls(const Mesh& mesh, const std::vector<Hull>& hulls,
                        const std::function<void(std::size_t)>& seen) {
  HullCheck check(mesh);
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    if (seen) seen(i);
    check.test(hulls[i], i);
  }
  return check.rows();
}

}  // namespace medial_vk::reference
