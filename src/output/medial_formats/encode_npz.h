// Medial points as NumPy arrays: a zip of .npy files, as numpy.savez writes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "medial_vk/sheets.h"
#include "output/medial_ply/medial_file.h"

namespace medial_vk {

/// docs/formats.md lists the arrays. They are stored, not compressed: the bytes of a compressed archive would depend on
/// the installed zlib. `marks`: PointMark by sphere. Error: kOutOfMemory.
Result<std::string> encode_npz(const MedialHeader& header, std::span<const MedialSphere> spheres,
                               std::span<const std::uint8_t> marks);

}  // namespace medial_vk
