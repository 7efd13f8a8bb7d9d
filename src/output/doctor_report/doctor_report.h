// The findings of `medial-vk doctor` as JSON (docs/report.md describes the keys).
#pragma once

#include <string>

#include "medial_vk/result.h"
#include "output/doctor_report/doctor_record.h"

namespace medial_vk {

/// `verdict`: ok, or the error that the program ends with.
std::string doctor_report_json(const DoctorRecord& record, const Status& verdict);

}  // namespace medial_vk
