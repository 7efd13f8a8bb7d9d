#include "medial_mesh/surface_complex.h"

#include <algorithm>
#include <utility>

namespace medial_vk {
namespace {

std::vector<std::array<std::uint32_t, 3>> sides_of(const DualComplex& complex) {
  const auto index_of = [&](std::uint32_t a, std::uint32_t b) {
    const auto found = std::lower_bound(complex.edges.begin(), complex.edges.end(), std::array{a, b});
    return static_cast<std::uint32_t>(found - complex.edges.begin());
  };
  std::vector<std::array<std::uint32_t, 3>> sides;
  sides.reserve(complex.triangles.size());
  for (const auto& [a, b, c] : complex.triangles) sides.push_back({index_of(a, b), index_of(a, c), index_of(b, c)});
  return sides;
}

}  // namespace

SurfaceComplex::SurfaceComplex(const DualComplex& complex, std::vector<bool> gone)
    : sides_(sides_of(complex)),
      starts_(complex.edges.size() + 1),
      counts_(complex.edges.size()),
      gone_edges_(complex.edges.size()),
      gone_triangles_(std::move(gone)) {
  for (std::uint32_t t = 0; t < sides_.size(); ++t) {
    if (!has_triangle(t)) continue;
    for (const std::uint32_t side : sides_[t]) ++counts_[side];
  }
  for (std::size_t e = 0; e < counts_.size(); ++e) starts_[e + 1] = starts_[e] + counts_[e];
  triangles_at_.resize(starts_.back());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (std::uint32_t t = 0; t < sides_.size(); ++t) {
    if (!has_triangle(t)) continue;
    for (const std::uint32_t side : sides_[t]) triangles_at_[next[side]++] = t;
  }
}

std::uint32_t SurfaceComplex::triangle_at(std::uint32_t edge, std::uint32_t but_for) const {
  std::size_t i = starts_[edge];
  while (triangles_at_[i] == but_for || !has_triangle(triangles_at_[i])) ++i;
  return triangles_at_[i];
}

std::vector<std::uint32_t> SurfaceComplex::free_edges() const {
  std::vector<std::uint32_t> free;
  for (std::uint32_t e = 0; e < counts_.size(); ++e) {
    if (counts_[e] == 1) free.push_back(e);
  }
  return free;
}

void SurfaceComplex::collapse(std::uint32_t edge) {
  const std::uint32_t triangle = triangle_at(edge);
  gone_triangles_[triangle] = true;
  gone_edges_[edge] = true;
  for (const std::uint32_t side : sides_[triangle]) --counts_[side];
}

}  // namespace medial_vk
