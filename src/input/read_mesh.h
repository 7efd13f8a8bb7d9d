// Reads a mesh file to triangles.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk {

/// No file is read beyond this size, since streams may have no end. The largest mesh that a device supports, 8 million
/// triangles, is half as long in the longest format (text STL).
inline constexpr std::uint64_t kMostFileBytes = 4ull << 30;

/// Reads OBJ, PLY, STL or OFF, determined by content where it is unambiguous and else by extension; "-" is standard
/// input. Errors: kInvalidMesh with file name and line, face or byte; also if there are more than `most_bytes`.
Result<Mesh> read_mesh(const std::string& path, std::uint64_t most_bytes = kMostFileBytes);

/// The name of an input in messages: the path, or words for standard input.
std::string name_of_input(const std::string& path);

/// The bytes of a file, or of standard input if its name is "-". Errors: as read_mesh(). Throws std::bad_alloc.
Result<std::string> read_mesh_bytes(const std::string& path, std::uint64_t most_bytes = kMostFileBytes);

/// Parses the bytes of a file; `name` is used in messages, and its extension where the content is ambiguous.
Result<Mesh> parse_mesh(std::string_view bytes, const std::string& name);

}  // namespace medial_vk
