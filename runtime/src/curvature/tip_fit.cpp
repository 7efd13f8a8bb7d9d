#include "curvature/tip_fit.h"

#include "curvature/robust_weights.h"
#include "curvature/window_gap.h"

namespace medial_vk {
namespace {

constexpr int kDegree = TipPatch::kDegree, kTerms = TipPatch::kTerms;
using Coefficients = TipPatch::Coefficients;

// On a cylinder of radius R the mean of the spokes of a window has the length 1 - (W / R)^2 / 16: here W = 1.26 R.
// Wider windows end where spokes are too steep, not at their radius, and would agree with each other.
constexpr double kLeastAlignment = 0.9;
constexpr double kLeastSteep = 0.2;  // of a spoke along the mean of its window: others are too steep for slopes

/// A tip in the frame of the fit, in units of the window's radius.
struct FramedTip {
  double x, y, height;
  std::array<double, 2> slopes;
  double weight;
};

struct FramedWindow {
  HeightFrame frame;
  double alignment = 0;  ///< The length of the mean spoke.
  std::vector<FramedTip> tips;
};

FramedWindow window_around(const Point& tip, const Point& outward, const TipCloud& members, const PointGrid& grid,
                           double radius) {
  struct Near {
    std::uint32_t tip;
    double weight;
  };
  std::vector<Near> near;
  Point sum = {0, 0, 0};
  double weights = 0;
  grid.visit_within(tip, radius, [&](std::uint32_t other, double squared) {
    if (!are_on_one_side(members.normals[other], outward)) return;
    const double left = 1 - squared / (radius * radius);
    near.push_back({other, left * left});
    weights += left * left;
    sum = sum + near.back().weight * members.normals[other];
  });
  FramedWindow window;
  if (near.empty()) return window;
  window.frame.up = 1 / length(sum) * sum;
  window.alignment = length(sum) / weights;
  window.frame.x = perpendicular_to(window.frame.up);
  window.frame.y = cross(window.frame.up, window.frame.x);
  window.tips.reserve(near.size());
  for (const Near& at : near) {
    const Point offset = 1 / radius * (members.tips[at.tip] - tip), &normal = members.normals[at.tip];
    const double steep = dot(normal, window.frame.up);
    if (steep < kLeastSteep) continue;
    window.tips.push_back({dot(offset, window.frame.x),
                           dot(offset, window.frame.y),
                           dot(offset, window.frame.up),
                           {-dot(normal, window.frame.x) / steep, -dot(normal, window.frame.y) / steep},
                           at.weight});
  }
  return window;
}

/// A polynomial for the heights and slopes of a window.
struct HeightFit {
  Coefficients coefficients;
  double mean_square = 0;   ///< Of the residuals of the heights.
  double slope_weight = 0;  ///< Heights and slopes have errors of different size: the ratio of their mean squares.
  NormalEquations<kTerms> equations;
};

double mean_square(const Moments<kDegree>::Matrix& matrix, const Coefficients& right, double squares, double weights,
                   const Coefficients& coefficients) {
  const double left = squares + coefficients.dot(matrix * coefficients - 2 * right);
  return weights > 0 ? std::max(0.0, left / weights) : 0;
}

bool fit_window(std::span<const FramedTip> tips, HeightFit& fit) {
  Moments<kDegree> moments;
  RightSide<kDegree> heights;
  std::array<RightSide<kDegree - 1>, 2> slopes;
  double squared_heights = 0, squared_slopes = 0;
  for (const FramedTip& tip : tips) {
    const auto monomials = monomials_at<2 * kDegree>(tip.x, tip.y);
    moments.add(monomials, tip.weight);
    heights.add(monomials, tip.weight * tip.height);
    for (std::size_t k = 0; k < 2; ++k) slopes[k].add(monomials, tip.weight * tip.slopes[k]);
    squared_heights += tip.weight * tip.height * tip.height;
    squared_slopes += tip.weight * (tip.slopes[0] * tip.slopes[0] + tip.slopes[1] * tip.slopes[1]);
  }
  const auto of_values = moments.matrix_of_values(), of_slopes = moments.matrix_of_slopes();
  const Coefficients values_right = heights.vector();
  Coefficients slopes_right;
  for (int degree = 0, at = 0; degree <= kDegree; ++degree) {
    for (int y = 0; y <= degree; ++y, ++at) {
      const int x = degree - y;
      slopes_right[at] =
          (x > 0 ? x * slopes[0][term_of(x - 1, y)] : 0) + (y > 0 ? y * slopes[1][term_of(x, y - 1)] : 0);
    }
  }
  for (int round = 0; round < 2; ++round) {
    if (!fit.equations.factor(of_values + fit.slope_weight * of_slopes)) return false;
    fit.coefficients = fit.equations.solve(values_right + fit.slope_weight * slopes_right);
    const double weights = moments.weights();
    fit.mean_square = mean_square(of_values, values_right, squared_heights, weights, fit.coefficients);
    const double slope = mean_square(of_slopes, slopes_right, squared_slopes, weights, fit.coefficients);
    // Where both are exact, nothing depends on the weight.
    if (slope > 0) fit.slope_weight = std::clamp(fit.mean_square / slope, 1e-4, 1.0);
  }
  return true;
}

void leave_out_strays(std::vector<FramedTip>& tips, const Coefficients& c) {
  std::vector<double> heights(tips.size()), slopes(tips.size());
  for (std::size_t i = 0; i < tips.size(); ++i) {
    const FramedTip& tip = tips[i];
    const auto monomials = monomials_at<kDegree>(tip.x, tip.y);
    double height = 0, along_x = 0, along_y = 0;
    for (int degree = 0, at = 0; degree <= kDegree; ++degree) {
      for (int y = 0; y <= degree; ++y, ++at) {
        const int x = degree - y;
        height += c[at] * monomials[static_cast<std::size_t>(at)];
        if (x > 0) along_x += c[at] * x * monomials[term_of(x - 1, y)];
        if (y > 0) along_y += c[at] * y * monomials[term_of(x, y - 1)];
      }
    }
    heights[i] = tip.height - height;
    // Not std::hypot, whose last bits differ between systems.
    slopes[i] = length(Point{tip.slopes[0] - along_x, tip.slopes[1] - along_y, 0});
  }
  const OutlierWeight of_height(heights), of_slope(slopes);
  for (std::size_t i = 0; i < tips.size(); ++i) tips[i].weight *= of_height(heights[i]) * of_slope(slopes[i]);
}

/// Slopes and second derivatives of a polynomial at a place.
struct Derivatives {
  Eigen::Vector2d slopes = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
};

Derivatives derivatives_at(const Coefficients& c, double x, double y) {
  Derivatives out;
  const auto monomials = monomials_at<kDegree>(x, y);
  for (int degree = 1, at = 1; degree <= kDegree; ++degree) {
    for (int of_y = 0; of_y <= degree; ++of_y, ++at) {
      const int of_x = degree - of_y;
      if (of_x > 0) out.slopes[0] += c[at] * of_x * monomials[term_of(of_x - 1, of_y)];
      if (of_y > 0) out.slopes[1] += c[at] * of_y * monomials[term_of(of_x, of_y - 1)];
      if (of_x > 1) out.second(0, 0) += c[at] * (of_x * (of_x - 1)) * monomials[term_of(of_x - 2, of_y)];
      if (of_y > 1) out.second(1, 1) += c[at] * (of_y * (of_y - 1)) * monomials[term_of(of_x, of_y - 2)];
      if (of_x > 0 && of_y > 0) out.second(0, 1) += c[at] * (of_x * of_y) * monomials[term_of(of_x - 1, of_y - 1)];
    }
  }
  out.second(1, 0) = out.second(0, 1);
  return out;
}

}  // namespace

/// With the slopes p, the second derivatives H and s = sqrt(1 + |p|^2), the normal of a graph is (-p, 1) / s and its
/// second fundamental form -H / s where convex is positive; the rows of the pseudo-inverse J^+ of J = (I; p^T) take it
/// to space: form = J^+^T (-H / s) J^+.
void TipPatch::add_at(const Point& p, double weight, TipFit& sum) const {
  const Point offset = 1 / radius * (p - origin);
  const Derivatives at = derivatives_at(coefficients, dot(offset, frame.x), dot(offset, frame.y));
  const double s = std::sqrt(1 + at.slopes.squaredNorm());
  Eigen::Matrix<double, 3, 2> tangents;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    tangents(k, 0) = frame.x[i] + at.slopes[0] * frame.up[i];
    tangents(k, 1) = frame.y[i] + at.slopes[1] * frame.up[i];
    sum.normal[i] += weight * (frame.up[i] - at.slopes[0] * frame.x[i] - at.slopes[1] * frame.y[i]) / s;
  }
  const Eigen::Matrix2d metric = tangents.transpose() * tangents;
  const Eigen::Matrix<double, 3, 2> dual = tangents * metric.inverse();
  sum.form += dual * (at.second * (-weight / (s * radius))) * dual.transpose();
  sum.spread += weight * spread;
}

TipPatch fit_patch(const TipCloud& cloud, std::uint32_t tip, const TipCloud& members, const PointGrid& grid,
                   double radius, bool is_wide) {
  TipPatch out;
  out.origin = cloud.tips[tip];
  out.radius = radius;
  FramedWindow window = window_around(cloud.tips[tip], cloud.normals[tip], members, grid, radius);
  if (window.tips.size() < kTerms || (is_wide && window.alignment < kLeastAlignment)) return out;
  HeightFit fit;
  fit.slope_weight = 0.01;
  if (!fit_window(window.tips, fit)) return out;
  leave_out_strays(window.tips, fit.coefficients);
  if (!fit_window(window.tips, fit)) return out;
  out.is_cut = has_gap(window.tips);
  out.frame = window.frame;
  out.coefficients = fit.coefficients;
  const double worst = 4 * std::max(fit.equations.inverse_diagonal(3), fit.equations.inverse_diagonal(5));
  out.spread = std::sqrt(fit.mean_square * worst) / radius;
  out.is_known = true;
  return out;
}

}  // namespace medial_vk
