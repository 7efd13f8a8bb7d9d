// Medial points as JSON, for general readers.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "medial_vk/sheets.h"
#include "output/medial_ply/medial_file.h"

namespace medial_vk {

/// An object with the header and an array "points", one line per point; docs/formats.md describes the layout. Numbers
/// have the fewest digits that read back exactly, floats as floats. `marks`: PointMark by sphere.
std::string encode_json(const MedialHeader& header, std::span<const MedialSphere> spheres,
                        std::span<const std::uint8_t> marks);

}  // namespace medial_vk
