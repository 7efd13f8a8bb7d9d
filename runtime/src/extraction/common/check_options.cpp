#include "extraction/common/check_options.h"

#include <cmath>
#include <string>
#include <utility>

namespace medial_vk {

Status check_options(const ExtractionOptions& options) {
  const auto usage = [](std::string message) { return Error{ErrorCode::kUsage, std::move(message)}; };
  if (options.resolution < 1 || options.resolution > 4096) return usage("`resolution` must be 1 to 4096");
  if (!(options.object_angle > 0 && options.object_angle < std::acos(0.0)))
    return usage("`object_angle` must be in (0, pi/2)");
  if (!(options.radius >= 0 && options.radius < 1)) return usage("`radius` must be in [0, 1)");
  if (!(options.epsilon >= 1e-3 && options.epsilon <= 0.5)) return usage("`epsilon` must be in [0.001, 0.5]");
  if (!(options.deep_angle > 0 && options.deep_angle < std::acos(0.0)))
    return usage("`deep_angle` must be in (0, pi/2)");
  if (options.extra_levels > 10) return usage("`extra_levels` must be at most 10");
  return {};
}

}  // namespace medial_vk
