#include "curvature_errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/point_ops.h"

namespace medial_vk::bench {

double degrees_between(const Point& a, const Point& b) {
  return 180 / std::numbers::pi * std::atan2(length(cross(a, b)), dot(a, b));
}

double Numbers::mean() const {
  double sum = 0;
  for (const double value : values_) sum += value;
  return sum / static_cast<double>(std::max<std::size_t>(1, values_.size()));
}

double Numbers::deviation() const {
  const double middle = mean();
  double squares = 0;
  for (const double value : values_) squares += (value - middle) * (value - middle);
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, values_.size())));
}

double Numbers::quantile(double share) {
  if (values_.empty()) return 0;
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(values_.size()));
  const auto at = values_.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values_.size() - 1));
  std::nth_element(values_.begin(), at, values_.end());
  return *at;
}

double error_scale(const SmoothPoint& truth, double greatest) {
  return std::max({std::fabs(truth.kappa[0]), std::fabs(truth.kappa[1]), greatest / 10});
}

void Errors::add(const SmoothPoint& truth, const Point& normal, const std::array<double, 2>& kappa,
                 const Point& direction, double estimate) {
  const double scale = error_scale(truth, greatest_);
  double worst = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double error = std::fabs(kappa[k] - truth.kappa[k]);
    worst = std::max(worst, error);
    kappas_[k].add(100 * error / scale);
  }
  ++known_;
  if (worst <= estimate) ++below_;
  if (!std::isnan(estimate)) estimates_.add(100 * estimate / scale);
  normals_.add(degrees_between(normal, truth.normal));
  // Where both curvatures are nearly equal, every direction is nearly principal.
  if (truth.kappa[0] - truth.kappa[1] < greatest_ / 10 || std::isnan(direction[0])) return;
  const double angle = degrees_between(direction, truth.directions[0]);
  directions_.add(std::min(angle, 180 - angle));
}

void Errors::print(const std::string& solid, const std::string& method) {
  const auto all = static_cast<double>(std::max<std::size_t>(1, known_ + unknown_));
  fmt::print("| {} | {} | {} | {:.1f} % | {:.2f} / {:.2f} | {:.2f} / {:.2f} | {:.1f} / {:.1f} | {:.3f} | {:.3f} | ",
             solid, method, known_, 100 * static_cast<double>(unknown_) / all, kappas_[0].mean(), kappas_[1].mean(),
             kappas_[0].quantile(0.95), kappas_[1].quantile(0.95), kappas_[0].quantile(1), kappas_[1].quantile(1),
             directions_.mean(), normals_.mean());
  if (below_ > 0) {
    fmt::print("{:.1f} % ({:.2f}) |\n", 100 * static_cast<double>(below_) / static_cast<double>(known_),
               estimates_.quantile(0.5));
  } else {
    fmt::print(" |\n");
  }
  std::fflush(stdout);
}

}  // namespace medial_vk::bench
