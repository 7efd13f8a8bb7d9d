// Medial points as NumPy arrays: a zip of .npy files, as numpy.savez writes it.
#pragma once

#include <span>
#include <string>

#include "output/medial_file.h"

namespace medial_vk {

/// The arrays are listed in docs/formats.md. Stored, not compressed: such numbers hardly get smaller, and a program may
/// map them. Error: kOutOfMemory.
Result<std::string> encode_npz(const MedialHeader& header, std::span<const MedialSphere> spheres);

}  // namespace medial_vk
