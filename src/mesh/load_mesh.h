// From a file to a prepared mesh.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "medial_vk/result.h"
#include "mesh/mesh.h"

namespace medial_vk {

/// No file is read beyond this: streams may have no end. The largest mesh that a device takes, 8 million triangles, is
/// half as long in the wordiest format (text STL).
inline constexpr std::uint64_t kMostFileBytes = 4ull << 30;

/// Reads OBJ, PLY, STL or OFF, by content where it is clear and else by extension; "-" is standard input.
/// Errors: kInvalidMesh with file name and line, face or byte; also if there are more than `most_bytes`.
Result<Mesh> read_mesh(const std::string& path, std::uint64_t most_bytes = kMostFileBytes);

/// The same from the bytes of a file; `name` is used in messages, and its extension where the content is not clear.
Result<Mesh> parse_mesh(std::string_view bytes, const std::string& name);

/// Drops degenerate and duplicate faces, unused vertices excluded from the bounding box, makes each component's
/// orientation consistent (and outward if the whole mesh is inside out), inspects, sets the flags.
/// Errors: kInvalidMesh if nothing is left, or nothing is enclosed.
Result<PreparedMesh> prepare_mesh(Mesh mesh);

/// Moves every vertex by a seeded random vector of length up to `amplitude` times the longest side (2.4.4).
void perturb_mesh(Mesh& mesh, double amplitude, std::uint64_t seed);

}  // namespace medial_vk
