// One function for each format; encode_hulls() chooses among them.
#pragma once

#include <string>

#include "medial_vk/result.h"
#include "output/hull_files/hull_record.h"

namespace medial_vk {

std::string encode_hulls_json(const HullRecord& record);
std::string encode_hulls_csv(const HullRecord& record);
std::string encode_hulls_ma(const HullRecord& record);
Result<std::string> encode_hulls_obj(const HullRecord& record);
Result<std::string> encode_hulls_usd(const HullRecord& record);
Result<std::string> encode_hulls_glb(const HullRecord& record);
Result<std::string> encode_hulls_gltf(const HullRecord& record);

/// "07" of 100: the number with the digits of the greatest, two at least, so that names are in the order of the hulls.
std::string number_text(std::size_t number, std::size_t count);

/// The error of inner_mesh() and posed_capsule() with the number of the hull, from 1.
Error with_hull(Error error, std::size_t index);

/// A radius is smaller than what the digits of the format lose: kCannotWrite.
Error too_thin();

}  // namespace medial_vk
