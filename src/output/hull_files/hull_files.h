// Hulls of balls as files (docs/formats.md, "Hulls").
#pragma once

#include <string>

#include "common/hull_format.h"
#include "medial_vk/result.h"
#include "output/hull_files/hull_record.h"

namespace medial_vk {

/// The greatest distance of a mesh of a hull from its surface, as a share of its greatest radius.
inline constexpr double kHullMeshShare = 0.01;

/// What the bytes hold is inside the hulls of the record. Errors: kCannotWrite (the format and the hull, if a radius is
/// smaller than what the digits of the format lose), kOutOfMemory.
Result<std::string> encode_hulls(HullFormat format, const HullRecord& record);

}  // namespace medial_vk
