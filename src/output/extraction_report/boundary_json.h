// The part of the report on what was measured on the boundary.
#pragma once

#include <nlohmann/json.hpp>

#include "output/extraction_report/run_record.h"

namespace medial_vk {

/// Null if nothing was measured.
nlohmann::ordered_json boundary_json(const BoundaryRecord& record);

}  // namespace medial_vk
