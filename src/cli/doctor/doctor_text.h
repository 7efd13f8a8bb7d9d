// The findings for readers.
#pragma once

#include <string>

#include "medial_vk/result.h"
#include "output/doctor_report/doctor_record.h"

namespace medial_vk::cli {

/// `verdict`: ok, or the error that the program ends with. `verbose` adds the folders that were searched, the lines of
/// the comparisons, and the messages of loader and drivers.
std::string doctor_text(const DoctorRecord& record, const Status& verdict, bool verbose);

}  // namespace medial_vk::cli
