// What to do about the findings.
#pragma once

#include <string>
#include <vector>

#include "output/doctor_report/doctor_record.h"

namespace medial_vk::cli {

/// Full sentences, the most useful first; none if there is nothing to do.
std::vector<std::string> advice_on(const DoctorRecord& record);

}  // namespace medial_vk::cli
