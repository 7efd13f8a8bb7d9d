// A picture of a mesh and its medial points, for a first view without other programs.
#pragma once

#include <span>
#include <string>

#include "medial_vk/context.h"
#include "medial_vk/medial_spheres.h"
#include "medial_vk/mesh.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/options.h"

namespace medial_vk {

/// A picture and a description of its painter: "NVIDIA H100, 16 samples per pixel", "the CPU: NVIDIA H100 has no
/// graphics queue".
struct DrawnPicture {
  Picture picture;
  std::string drawn_by;
};

/// The mesh, the points and a legend, according to the options; `voxel_size` determines the size of the discs. The
/// Vulkan device described by `device` draws; without one, or if it cannot draw, the CPU does. There is no randomness:
/// the same input gives the same pixels on the same device.
DrawnPicture draw_picture(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                          const PictureOptions& options, const DeviceDescription* device);

/// Draws on the CPU, on one thread.
Picture draw_picture(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                     const PictureOptions& options = {});

}  // namespace medial_vk
