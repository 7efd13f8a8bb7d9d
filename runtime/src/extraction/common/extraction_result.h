// The conversion of the device's results to those of the caller: grid, units, order, times.
#pragma once

#include <algorithm>
#include <vector>

#include "base/voxel_order.h"
#include "device_mesh/device_mesh.h"
#include "gpu_types.h"
#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// Voxels of side longest / resolution that cover the bounding box.
VoxelGrid make_grid(const DeviceMesh& mesh, std::uint32_t resolution);

MedialSphere to_input_units(const gpu::FoundPoint& found, const DeviceMesh& mesh);
UndecidedVoxel to_input_units(const gpu::UndecidedCell& cell, const DeviceMesh& mesh);

/// Sorts into voxel order.
template <typename T>
void sort_by_voxel(std::vector<T>& values) {
  std::sort(values.begin(), values.end(), [](const T& a, const T& b) { return is_earlier_voxel(a.voxel, b.voxel); });
}

/// Adds up times of the same stage.
void add_times(const std::vector<StageTime>& times, std::vector<StageTime>& sum);

}  // namespace medial_vk
