#include "deforming_torus.h"

#include <cmath>
#include <numbers>

namespace {

using medial_vk::Point;

Point cross_product(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

}  // namespace

DeformingTorus::DeformingTorus(std::uint32_t around, std::uint32_t along) : around_(around), along_(along) {
  vertices_.resize(std::size_t{around} * along);
  for (std::uint32_t i = 0; i < along; ++i) {
    for (std::uint32_t j = 0; j < around; ++j) {
      const std::uint32_t next_i = (i + 1) % along, next_j = (j + 1) % around;
      const std::uint32_t a = i * around + j, b = next_i * around + j, c = next_i * around + next_j,
                          d = i * around + next_j;
      triangles_.push_back({a, b, c});
      triangles_.push_back({a, c, d});
    }
  }
  // The mesh is closed, correctly oriented and never meets itself, so all normals can be trusted.
  flags_.assign(triangles_.size(), medial_vk::kTrustedNormal);
  deform(0);
}

void DeformingTorus::deform(double phase) {
  constexpr double kTurn = 2 * std::numbers::pi;
  for (std::uint32_t i = 0; i < along_; ++i) {
    const double u = kTurn * i / along_;
    const double wave = 1 + 0.25 * std::sin(4 * u + kTurn * phase);
    const double lift = 0.12 * std::sin(2 * u + kTurn * phase);
    for (std::uint32_t j = 0; j < around_; ++j) {
      const double v = kTurn * j / around_;
      const double radius = 1 + 0.4 * wave * std::cos(v);
      vertices_[std::size_t{i} * around_ + j] = {radius * std::cos(u), radius * std::sin(u),
                                                 0.15 * wave * std::sin(v) + lift};
    }
  }
}

void DeformingTorus::write_vertices(float* to) const {
  for (std::uint32_t i = 0; i < along_; ++i) {
    for (std::uint32_t j = 0; j < around_; ++j) {
      const auto at = [&](std::uint32_t along, std::uint32_t around) {
        return vertices_[std::size_t{along % along_} * around_ + around % around_];
      };
      const Point p = at(i, j);
      const Point normal = cross_product(difference(at(i + 1, j), at(i + along_ - 1, j)),
                                         difference(at(i, j + 1), at(i, j + around_ - 1)));
      const double size = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      for (int k = 0; k < 3; ++k) *to++ = static_cast<float>(p[k]);
      for (int k = 0; k < 3; ++k) *to++ = static_cast<float>(normal[k] / size);
    }
  }
}

void DeformingTorus::write_indices(std::uint32_t* to) const {
  for (const medial_vk::Triangle& t : triangles_)
    for (const std::uint32_t vertex : t) *to++ = vertex;
}
