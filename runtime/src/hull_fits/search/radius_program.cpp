#include "hull_fits/search/radius_program.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace medial_vk {
namespace {

/// Solutions of up to three equations have errors of some units in the last place where the boundaries meet at angles
/// that are not tiny; a meeting that is rejected for more leaves others, or a smaller sum of radii.
constexpr double kRounding = 0x1p-44;

}  // namespace

RadiusProgram::RadiusProgram(std::size_t count, double least, const std::array<double, 3>& greatest)
    : count_(count), radii_(greatest) {
  spaces_.reserve(16);
  for (std::size_t i = 0; i < count; ++i) {
    HalfSpace above = {{}, greatest[i]}, below = {{}, -least};
    above.a[i] = 1;
    below.a[i] = -1;
    spaces_.push_back(above);
    spaces_.push_back(below);
    scale_ = std::max(scale_, greatest[i]);
    if (greatest[i] < least) is_feasible_ = false;
  }
  for (std::size_t i = count; i < 3; ++i) radii_[i] = 0;
}

bool RadiusProgram::holds(const std::array<double, 3>& radii, const HalfSpace& space) const {
  double product = 0;
  for (std::size_t k = 0; k < count_; ++k) product += space.a[k] * radii[k];
  return product <= space.b + kRounding * scale_;
}

bool RadiusProgram::add(const std::array<double, 3>& weight, double bound) {
  spaces_.push_back({weight, bound});
  if (!is_feasible_ || holds(radii_, spaces_.back())) return is_feasible_;
  const std::size_t wall = spaces_.size() - 1;
  double best = -std::numeric_limits<double>::infinity();
  is_feasible_ = false;
  for (std::size_t i = 0; i < wall; ++i) {
    if (count_ < 3) {
      try_meeting(wall, i, i, best);
      continue;
    }
    for (std::size_t j = i + 1; j < wall; ++j) try_meeting(wall, i, j, best);
  }
  return is_feasible_;
}

/// Takes the radii at the meeting of boundaries, by Cramer's rule, if they are better and satisfy all constraints.
void RadiusProgram::try_meeting(std::size_t wall, std::size_t second, std::size_t third, double& best) {
  const auto& [p, b0] = spaces_[wall];
  const auto& [q, b1] = spaces_[second];
  const auto& [s, b2] = spaces_[third];
  std::array<double, 3> radii = {};
  if (count_ == 1) {
    if (p[0] == 0) return;
    radii[0] = b0 / p[0];
  } else if (count_ == 2) {
    const double determinant = p[0] * q[1] - p[1] * q[0];
    if (std::fabs(determinant) < kRounding) return;
    radii = {(b0 * q[1] - p[1] * b1) / determinant, (p[0] * b1 - b0 * q[0]) / determinant, 0};
  } else {
    const std::array<double, 3> qs = {q[1] * s[2] - q[2] * s[1], q[2] * s[0] - q[0] * s[2], q[0] * s[1] - q[1] * s[0]};
    const double determinant = p[0] * qs[0] + p[1] * qs[1] + p[2] * qs[2];
    if (std::fabs(determinant) < kRounding) return;
    const std::array<double, 3> sp = {s[1] * p[2] - s[2] * p[1], s[2] * p[0] - s[0] * p[2], s[0] * p[1] - s[1] * p[0]};
    const std::array<double, 3> pq = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    for (std::size_t k = 0; k < 3; ++k) radii[k] = (b0 * qs[k] + b1 * sp[k] + b2 * pq[k]) / determinant;
  }
  double sum = 0;
  for (std::size_t k = 0; k < count_; ++k) sum += radii[k];
  if (!(sum > best)) return;
  for (const HalfSpace& space : spaces_) {
    if (!holds(radii, space)) return;
  }
  best = sum;
  radii_ = radii;
  is_feasible_ = true;
}

}  // namespace medial_vk
