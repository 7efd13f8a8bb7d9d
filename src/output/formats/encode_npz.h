// Medial points as NumPy arrays: a zip of .npy files, as numpy.savez writes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "medial_vk/sheets.h"
#include "output/medial_file/medial_file.h"

namespace medial_vk {

/// The arrays are listed in docs/formats.md. Stored, not compressed: the bytes of a compressed archive would depend on
/// the zlib that is installed. `marks`: PointMark by sphere. Error: kOutOfMemory.
Result<std::string> encode_npz(const MedialHeader& header, std::span<const MedialSphere> spheres,
                               std::span<const std::uint8_t> marks);

}  // namespace medial_vk
