// A picture of a mesh and its medial points: a first look without any viewer.
#pragma once

#include <span>
#include <string>

#include "medial_vk/context.h"
#include "medial_vk/extraction.h"
#include "medial_vk/mesh.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/options.h"

namespace medial_vk {

/// A picture with who drew it: "NVIDIA H100, 16 samples per pixel", "the CPU: NVIDIA H100 has no graphics queue".
struct DrawnPicture {
  Picture picture;
  std::string drawn_by;
};

/// The mesh, the points and a legend, as the options say; `voxel_size` sets the size of the discs. On the Vulkan device
/// that `device` describes; without one, or if that cannot draw, on the CPU. No randomness: the same input gives the
/// same pixels on the same device.
DrawnPicture draw_picture(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                          const PictureOptions& options, const DeviceDescription* device);

/// The same on the CPU, one thread.
Picture draw_picture(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                     const PictureOptions& options = {});

}  // namespace medial_vk
