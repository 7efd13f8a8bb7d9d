// The report of `medial-vk spheres`.
#pragma once

#include <string>

#include "output/fit_reports/fits_record.h"

namespace medial_vk {

/// JSON; every key is described in docs/report.md.
std::string encode_fits_report(const FitsRecord& record);

}  // namespace medial_vk
