// Medial points as JSON, for whatever reads nothing else.
#pragma once

#include <span>
#include <string>

#include "output/medial_file.h"

namespace medial_vk {

/// An object with the header and an array "points", a line each; layout in docs/formats.md. Numbers have the fewest
/// digits that read back exactly, floats as floats.
std::string encode_json(const MedialHeader& header, std::span<const MedialSphere> spheres);

}  // namespace medial_vk
