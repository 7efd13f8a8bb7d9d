#include "curvature/sheet_fit.h"

#include "curvature/polynomial_fit.h"
#include "curvature/robust_weights.h"
#include "curvature/window_gap.h"

namespace medial_vk {
namespace {

/// A ball in the frame of the fit, in units of the window's radius.
struct FramedBall {
  double x, y, height, squared_radius, weight;
};

/// Two axes along the sheet, and its normal.
struct SheetFrame {
  Point x, y, normal;
};

SheetFrame frame_along(const Point& normal) {
  const Point x = perpendicular_to(normal);
  return {x, cross(normal, x), normal};
}

/// Height and squared radius over the plane of the frame: value and slopes at the middle.
template <int Degree>
bool fit_polynomials(std::vector<FramedBall>& balls, Eigen::Matrix<double, 3, 2>& at_middle) {
  constexpr int kTerms = terms_of(Degree);
  if (balls.size() < 3 * kTerms / 2) return false;
  std::vector<double> heights(balls.size()), radii(balls.size());
  for (int pass = 0; pass < 2; ++pass) {
    Moments<Degree> moments;
    RightSide<Degree> of_heights, of_radii;
    for (const FramedBall& ball : balls) {
      const auto monomials = monomials_at<2 * Degree>(ball.x, ball.y);
      moments.add(monomials, ball.weight);
      of_heights.add(monomials, ball.weight * ball.height);
      of_radii.add(monomials, ball.weight * ball.squared_radius);
    }
    NormalEquations<kTerms> equations;
    if (!equations.factor(moments.matrix_of_values())) return false;
    const Eigen::Matrix<double, kTerms, 1> height = equations.solve(of_heights.vector());
    const Eigen::Matrix<double, kTerms, 1> radius = equations.solve(of_radii.vector());
    at_middle << height.template head<3>(), radius.template head<3>();
    if (pass > 0) break;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const auto monomials = monomials_at<Degree>(balls[i].x, balls[i].y);
      const Eigen::Map<const Eigen::Matrix<double, kTerms, 1>> row(monomials.data());
      heights[i] = balls[i].height - row.dot(height);
      radii[i] = balls[i].squared_radius - row.dot(radius);
    }
    const OutlierWeight of_height(heights), of_radius(radii);
    for (std::size_t i = 0; i < balls.size(); ++i) {
      balls[i].weight *= of_height(heights[i]) * of_radius(radii[i]);
    }
  }
  return true;
}

}  // namespace

SheetFit fit_sheet(const SheetLinks& links, std::uint32_t ball, std::span<const SheetWindow::Member> members,
                   double radius, std::span<const std::uint8_t> is_kept) {
  SheetFit out;
  const Ball& middle = links.balls()[ball];
  const SheetFrame frame = frame_along(links.shape(ball).direction);
  std::vector<FramedBall> balls;
  balls.reserve(members.size());
  const double unit = 1 / radius, of_middle = middle.radius * unit;
  for (const SheetWindow::Member& member : members) {
    const double share = member.distance * unit;
    if (share >= 1 || is_kept[member.ball] == 0) continue;
    const Ball& other = links.balls()[member.ball];
    const Point offset = unit * (other.centre - middle.centre);
    const double difference = unit * (other.radius - middle.radius), weight = (1 - share * share) * (1 - share * share);
    balls.push_back({dot(offset, frame.x), dot(offset, frame.y), dot(offset, frame.normal),
                     difference * (unit * other.radius + of_middle), weight});
  }
  Eigen::Matrix<double, 3, 2> fit;
  const bool is_wide = radius > 4.5 * links.spacing();
  if (!(is_wide ? fit_polynomials<4>(balls, fit) : fit_polynomials<3>(balls, fit))) return out;
  out.is_cut = has_gap(balls);
  // The gradient of r = sqrt(r^2) in the metric of the surface (x, y, height): with h the slopes of the height and q
  // those of r, the metric is I + h h^T, its inverse I - h h^T / (1 + |h|^2).
  const double squared = of_middle * of_middle + fit(0, 1);
  if (!(squared > 0)) return out;
  const double r = std::sqrt(squared);
  const Eigen::Vector2d h = fit.block<2, 1>(1, 0), q = fit.block<2, 1>(1, 1) / (2 * r);
  const double stretch = 1 + h.squaredNorm();
  const Eigen::Vector2d g = q - h * (h.dot(q) / stretch);
  const Point gradient = g[0] * frame.x + g[1] * frame.y + g.dot(h) * frame.normal;
  const double across = 1 - dot(gradient, gradient);
  if (!(across > 0)) return out;
  const Point normal = 1 / std::sqrt(stretch) * (frame.normal - h[0] * frame.x - h[1] * frame.y);
  const Point centre = middle.centre + radius * fit(0, 0) * frame.normal;
  for (std::size_t side = 0; side < 2; ++side) {
    out.spokes[side] = (side == 0 ? 1 : -1) * std::sqrt(across) * normal - gradient;
    out.tips[side] = centre + radius * r * out.spokes[side];
  }
  out.is_known = true;
  return out;
}

}  // namespace medial_vk
