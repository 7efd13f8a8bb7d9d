// The content of a driver file (ICD file): JSON that names the library of a driver.
#pragma once

#include <string>
#include <string_view>

#include "output/doctor_report/doctor_record.h"

namespace medial_vk::cli {

/// Reads `driver.file`, and fills its library, version and problem.
void read_manifest(DriverRecord& driver);

/// The same from bytes that have been read.
void read_manifest(std::string_view bytes, DriverRecord& driver);

}  // namespace medial_vk::cli
