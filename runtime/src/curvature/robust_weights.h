// Weights that leave out what does not follow the rest.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace medial_vk {

/// Tukey's biweight of residuals, with a width of six times their standard deviation as the median of the magnitudes
/// gives it for a normal distribution: it changes such residuals little, and ignores those of another surface.
class OutlierWeight {
 public:
  explicit OutlierWeight(std::span<const double> residuals) {
    std::vector<double> magnitudes(residuals.begin(), residuals.end());
    for (double& value : magnitudes) value = std::fabs(value);
    const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
    std::nth_element(magnitudes.begin(), middle, magnitudes.end());
    width_ = 6 * 1.4826 * *middle;
  }

  double operator()(double residual) const {
    // Residuals of rounding alone all count: their median may be 0.
    const double width = std::max(width_, 1e-12), share = residual / width;
    if (std::fabs(share) >= 1) return 0;
    return (1 - share * share) * (1 - share * share);
  }

 private:
  double width_ = 0;
};

}  // namespace medial_vk
