// Balls as one triangle mesh, for programs that draw meshes only: `--mesh-spheres`.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "output/medial_ply/medial_file.h"

namespace medial_vk {

/// The size limit of files of balls, for the program as writer and as reader.
inline constexpr std::uint64_t kLargestBallFile = 4096ull << 20;

/// The requested detail; otherwise the largest up to kUsualSphereDetail with which `balls` of `bytes(detail)` each stay
/// below kLargestBallFile. Error kCannotWrite, with a remedy, if none does.
Result<std::uint32_t> choose_sphere_detail(std::optional<std::uint32_t> requested, std::uint64_t balls,
                                           std::uint64_t (*bytes)(std::uint32_t detail));

/// The radius with which the vertices of a ball are computed, such that no vertex is outside the ball after its
/// coordinates are rounded: `rounding` is 2^-50 for doubles, 2^-23 for floats (derivation at the definition).
double inscribed_radius(const Point& centre, double radius, double rounding);

/// A PLY with the vertices of all balls in the order of `spheres`, each with the radius, object angle, sheet and colour
/// of its ball, and the triangles; the comments are those of the medial PLY, and the detail. Error: kCannotWrite.
Result<std::string> encode_ball_mesh_ply(const MedialHeader& header, std::span<const MedialSphere> spheres, bool ascii,
                                         std::optional<std::uint32_t> wanted_detail);

}  // namespace medial_vk
