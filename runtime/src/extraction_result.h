// From what the device found to what the caller gets: the grid, units, order, times.
#pragma once

#include <vector>

#include "gpu_types.h"
#include "medial_vk/extraction.h"
#include "scene.h"

namespace medial_vk {

/// Voxels of side longest / resolution that cover the bounding box.
VoxelGrid make_grid(const DeviceMesh& mesh, std::uint32_t resolution);

MedialSphere to_input_units(const gpu::FoundPoint& found, const DeviceMesh& mesh);

/// z slowest, then y, then x.
void sort_by_voxel(std::vector<MedialSphere>& spheres);

/// Times of the same stage add up.
void add_times(const std::vector<StageTime>& times, std::vector<StageTime>& sum);

}  // namespace medial_vk
