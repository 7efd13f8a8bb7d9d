// One reader per format, from bytes in memory. All return kInvalidMesh with file name and line, face or byte.
// The indices of what they return are valid, the coordinates finite; there may be no triangle.
#pragma once

#include <string>
#include <string_view>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

Result<Mesh> read_obj(std::string_view bytes, const std::string& name);
Result<Mesh> read_ply(std::string_view bytes, const std::string& name);
Result<Mesh> read_off(std::string_view bytes, const std::string& name);
Result<Mesh> read_ascii_stl(std::string_view bytes, const std::string& name);
Result<Mesh> read_binary_stl(std::string_view bytes, const std::string& name);

/// Is the size of the file that which a binary STL's triangle count calls for? (Some begin with "solid" as well.)
bool has_size_of_binary_stl(std::string_view bytes);

/// Indices are 32 bits wide, and the last value is kept for "none".
constexpr std::uint64_t kMaxVertices = 0xfffffffe;
/// Of one face: their number is kept in 32 bits.
constexpr std::uint64_t kMaxCorners = 0xffffffff;

}  // namespace medial_vk
