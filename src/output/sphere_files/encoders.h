// One function per format of sphere sets, for encode_spheres() only.
#pragma once

#include <string>

#include "output/sphere_files/sphere_file.h"

namespace medial_vk {

std::string encode_spheres_csv(const SphereFile& file);
std::string encode_spheres_json(const SphereFile& file);
std::string encode_spheres_foam(const SphereFile& file);
std::string encode_spheres_curobo(const SphereFile& file);
std::string encode_spheres_xrdf(const SphereFile& file);
/// Error: kInternal.
Result<std::string> encode_spheres_urdf(const SphereFile& file);

/// Text as a JSON string, in quotes; bytes that are not UTF-8 are replaced.
std::string json_text(const std::string& text);

}  // namespace medial_vk
