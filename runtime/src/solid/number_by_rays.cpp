#include "solid/number_by_rays.h"

#include <array>
#include <limits>

#include "bvh/signed_crossings.h"

namespace medial_vk {
namespace {

// A ray that passes an edge passes none in most other directions.
constexpr std::array<std::array<double, 2>, 4> kAcross = {
    {{0.1373, 0.2917}, {-0.2339, 0.1713}, {0.3191, -0.1131}, {-0.0729, -0.3571}}};

/// Mostly along the axis along which the box ends soonest.
Point direction_out(const BvhBox& box, const Point& p, const std::array<double, 2>& across) {
  std::size_t axis = 0;
  double nearest = std::numeric_limits<double>::infinity(), along = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const bool up : {false, true}) {
      const double left = up ? box.upper[k] - p[k] : p[k] - box.lower[k];
      if (left >= nearest) continue;
      nearest = left;
      axis = k;
      along = up ? 1 : -1;
    }
  }
  Point direction;
  direction[axis] = along;
  direction[(axis + 1) % 3] = across[0];
  direction[(axis + 2) % 3] = across[1];
  return direction;
}

std::optional<std::int64_t> number_along(std::initializer_list<const Bvh*> trees, const Point& p,
                                         const Point& direction) {
  std::int64_t number = 0;
  for (const Bvh* tree : trees) {
    const std::optional<std::int64_t> crossings = signed_crossings(*tree, p, direction);
    if (!crossings) return std::nullopt;
    number += *crossings;
  }
  return number;
}

}  // namespace

std::optional<std::int64_t> number_by_rays(std::initializer_list<const Bvh*> trees, const Point& p) {
  const BvhBox& box = (*trees.begin())->nodes().front().box;
  for (const auto& across : kAcross) {
    if (const auto number = number_along(trees, p, direction_out(box, p, across))) return number;
  }
  return std::nullopt;
}

}  // namespace medial_vk
