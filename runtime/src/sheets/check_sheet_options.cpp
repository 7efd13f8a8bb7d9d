#include "sheets/check_sheet_options.h"

namespace medial_vk {

Status check_sheet_options(const SheetOptions& options) {
  const auto usage = [](const char* message) { return Error{ErrorCode::kUsage, message}; };
  // Written so that a NaN is out of range, too.
  if (!(options.angle >= 0 && options.angle <= 90)) return usage("`angle` must be 0 to 90 degrees");
  if (!(options.crease >= 0 && options.crease <= 180)) return usage("`crease` must be 0 to 180 degrees");
  if (!(options.border >= 0 && options.border <= 180)) return usage("`border` must be 0 to 180 degrees");
  if (!(options.width >= 0 && options.width <= 1)) return usage("`width` must be 0 to 1");
  return {};
}

}  // namespace medial_vk
