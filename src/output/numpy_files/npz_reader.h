// NumPy arrays from a file that may hold anything.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

struct NpyArray {
  std::string type;                  ///< "<f8" and so on, as in the file.
  std::vector<std::uint64_t> shape;  ///< Lengths along the axes.
  std::string bytes;                 ///< As many as type and shape require.
};

constexpr std::size_t kMostNpzMembers = 64;

/// The arrays of a .npz by name, without ".npy". Only files that are stored without compression are read, as
/// numpy.savez writes them, of little-endian numbers, truth values and text, in C order: an archive never expands.
/// `name` is that of the file in messages. Errors: kInvalidMesh ("name: what", among others a CRC-32 that is not that
/// of the bytes), kOutOfMemory.
Result<std::map<std::string, NpyArray>> read_npz(std::string_view bytes, const std::string& name);

}  // namespace medial_vk
