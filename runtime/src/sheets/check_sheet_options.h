// The ranges of SheetOptions.
#pragma once

#include "medial_vk/result.h"
#include "medial_vk/sheets.h"

namespace medial_vk {

/// Error: kUsage, with a message that names the member out of range.
Status check_sheet_options(const SheetOptions& options);

}  // namespace medial_vk
