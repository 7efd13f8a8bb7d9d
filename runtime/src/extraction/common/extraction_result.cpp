#include "extraction/common/extraction_result.h"

#include <algorithm>
#include <cmath>

namespace medial_vk {

VoxelGrid make_grid(const DeviceMesh& mesh, std::uint32_t resolution) {
  VoxelGrid grid;
  grid.origin = mesh.lower;
  grid.voxel_size = mesh.longest / resolution;
  for (int axis = 0; axis < 3; ++axis) {
    // The longest side is `resolution` voxels up to rounding: rounding adds no layer.
    const double cells = std::ceil((mesh.upper[axis] - mesh.lower[axis]) / grid.voxel_size - 1e-9);
    grid.size[axis] = static_cast<std::uint32_t>(std::clamp(cells, 1.0, static_cast<double>(resolution)));
  }
  return grid;
}

MedialSphere to_input_units(const gpu::FoundPoint& found, const DeviceMesh& mesh) {
  MedialSphere sphere;
  sphere.centre = mesh.to_input({found.centre.x, found.centre.y, found.centre.z});
  sphere.radius = mesh.longest * double{found.centre.w};
  sphere.spoke_a = {found.spoke_a.x, found.spoke_a.y, found.spoke_a.z};
  sphere.spoke_b = {found.spoke_b.x, found.spoke_b.y, found.spoke_b.z};
  sphere.object_angle = found.spoke_a.w;
  sphere.flux = found.spoke_b.w;
  sphere.voxel = {found.voxel_x, found.voxel_y, found.voxel_z};
  return sphere;
}

UndecidedVoxel to_input_units(const gpu::UndecidedCell& cell, const DeviceMesh& mesh) {
  static_assert(gpu::kNearFace == static_cast<gpu::uint>(UndecidedKind::kNearFace));
  static_assert(gpu::kOtherReason == static_cast<gpu::uint>(UndecidedKind::kOther));
  return {{cell.x, cell.y, cell.z},
          static_cast<UndecidedKind>(cell.kind),
          static_cast<float>(mesh.longest * double{cell.width})};
}

void add_times(const std::vector<StageTime>& times, std::vector<StageTime>& sum) {
  for (const StageTime& time : times) {
    const auto same = std::find_if(sum.begin(), sum.end(), [&](const StageTime& s) { return s.stage == time.stage; });
    if (same == sum.end()) {
      sum.push_back(time);
    } else {
      same->seconds += time.seconds;
    }
  }
}

}  // namespace medial_vk
