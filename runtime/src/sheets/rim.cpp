#include "sheets/rim.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include "sheets/tangent_frame.h"

namespace medial_vk {

// Within a sheet voxels have neighbours all around, and a gap is at most half of that, for any positions of points in
// their voxels. A sheet does not rise by 70 degrees from a voxel to the next, so steeper neighbours belong to another
// layer of it, as in a wall between voxels, or to another sheet.
bool is_rim(const VoxelGraph& graph, std::uint32_t position) {
  constexpr double kGap = 2 * std::numbers::pi / 3;
  constexpr double kSteep = 0.9;  // the square of the sine of 71.6 degrees
  const Point normal = sheet_normal(graph.sphere(position));
  const TangentFrame frame(normal);
  std::array<double, 26> angles;
  std::size_t count = 0;
  for (const std::uint32_t other : graph.neighbours(position)) {
    if (count == angles.size()) break;
    const Point direction = graph.sphere(other).centre - graph.sphere(position).centre;
    const double above = dot(normal, direction);
    if (above * above > kSteep * dot(normal, normal) * dot(direction, direction)) continue;
    angles[count++] = frame.angle(direction);
  }
  if (count == 0) return true;
  std::sort(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(count));
  double widest = angles[0] + 2 * std::numbers::pi - angles[count - 1];
  for (std::size_t i = 1; i < count; ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest >= kGap;
}

}  // namespace medial_vk
