// A picture of a mesh and its medial points, drawn on the CPU: a first look without any viewer.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "medial_vk/extraction.h"
#include "medial_vk/result.h"
#include "mesh/mesh.h"

namespace medial_vk {

/// Rows from the top, three bytes (red, green, blue) per pixel.
struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;
};

struct PictureOptions {
  std::uint32_t width = 1200;
  std::uint32_t height = 900;
  double least_angle = 0.6;  ///< Object angle at the lower end of the colours, radians; the upper end is pi/2.
};

/// The mesh as glass, the points as small discs in the medial sheet coloured by object angle, and a legend; seen from
/// the right, the front and above, y up. `voxel_size` sets the size of the discs. One thread, no randomness: the same
/// input gives the same pixels.
Picture draw_picture(const Mesh& mesh, std::span<const MedialSphere> spheres, double voxel_size,
                     const PictureOptions& options = {});

/// The bytes of a PNG file. Error: kOutOfMemory.
Result<std::string> encode_png(const Picture& picture);

}  // namespace medial_vk
