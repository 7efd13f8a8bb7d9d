// Parallel lines along the three axes, and their stretches inside a solid (dexels; T. Van Hook, "Real-time shaded NC
// milling display", 1986): integrals over space become sums over lines, exact along each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solid/solid.h"

namespace medial_vk {

/// Safe to share between threads.
class SolidLines {
 public:
  /// For every axis, lines through the middles of equal rectangles that fill the solid's box: `per_side` along its
  /// longest side, and with the same spacing along the others, but at least `least`. Precondition: a closed mesh.
  /// Throws std::bad_alloc.
  SolidLines(const Solid& solid, std::size_t per_side, std::size_t least);

  struct Stretch {
    double from, to;  ///< Coordinates along the line.
  };
  /// The lines along one axis.
  struct Bundle {
    std::array<std::size_t, 2> across;    ///< The other axes, in cyclic order.
    std::array<double, 2> first;          ///< Coordinates of the first line on those.
    std::array<double, 2> spacing;        ///< From one line to the next.
    std::array<std::ptrdiff_t, 2> count;  ///< Of lines along those.
    std::vector<std::size_t> starts;      ///< By line: its first stretch, and one more.
    std::vector<Stretch> inside;          ///< Of all lines, in ascending order on each.

    /// Coordinate of the lines of that number along across[k].
    double at(std::size_t k, std::ptrdiff_t number) const {
      return first[k] + spacing[k] * static_cast<double>(number);
    }
    /// Of the line of these numbers along `across`; none beyond the box.
    std::span<const Stretch> stretches(std::ptrdiff_t i, std::ptrdiff_t j) const {
      if (i < 0 || j < 0 || i >= count[0] || j >= count[1]) return {};
      const auto line = static_cast<std::size_t>(j * count[0] + i);
      return {inside.data() + starts[line], starts[line + 1] - starts[line]};
    }
  };
  const Bundle& along(std::size_t axis) const { return bundles_[axis]; }
  /// Volume of the solid, as the mean over the axes.
  double volume() const;

 private:
  std::array<Bundle, 3> bundles_;
};

}  // namespace medial_vk
