// The formats of files of hulls.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "medial_vk/result.h"

namespace medial_vk {

enum class HullFormat : std::uint8_t {
  kJson,  ///< All numbers, with the proof.
  kCsv,   ///< A row for each hull: its balls.
  kMa,    ///< The `.ma` of Q-MAT: balls, edges and triangles.
  kUsd,   ///< USD text: spheres, capsules and meshes with the collision API.
  kGlb,   ///< glTF: a mesh for each hull, and implicit shapes.
  kGltf,  ///< The same as text.
  kObj,   ///< A mesh for each hull.
};

inline constexpr std::array<HullFormat, 7> kHullFormats = {HullFormat::kJson, HullFormat::kCsv, HullFormat::kMa,
                                                           HullFormat::kUsd,  HullFormat::kGlb, HullFormat::kGltf,
                                                           HullFormat::kObj};

/// The word of the option, which is also the extension of files.
const char* name_of(HullFormat format);

/// By the extension of a file's name. Error: kUsage, with the known extensions.
Result<HullFormat> hull_format_of(const std::string& path);

}  // namespace medial_vk
