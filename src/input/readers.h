// One reader per format, from bytes in memory. All return kInvalidMesh with file name and line, face or byte. The
// indices of the result are valid and its coordinates finite; it may have no triangles.
#pragma once

#include <string>
#include <string_view>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

Result<Mesh> read_obj(std::string_view bytes, const std::string& name);
Result<Mesh> read_ply(std::string_view bytes, const std::string& name);
Result<Mesh> read_off(std::string_view bytes, const std::string& name);
/// `bytes` begin after the line of the keyword, whose prefixes name the values of a vertex.
Result<Mesh> read_binary_off(std::string_view bytes, std::string_view keyword, const std::string& name);
Result<Mesh> read_ascii_stl(std::string_view bytes, const std::string& name);
Result<Mesh> read_binary_stl(std::string_view bytes, const std::string& name);

/// True if the size of the file is that which its triangle count as a binary STL requires. (Some binary files begin
/// with "solid", too.)
bool has_size_of_binary_stl(std::string_view bytes);

/// Indices are 32 bits wide, and the last value is reserved for "none".
constexpr std::uint64_t kMaxVertices = 0xfffffffe;
/// The limit for one face, because the number of its corners is stored in 32 bits.
constexpr std::uint64_t kMaxCorners = 0xffffffff;

}  // namespace medial_vk
