#include "base/format_text.h"

#include <fmt/format.h>

namespace medial_vk {

std::string format_text_of(fmt::string_view format, fmt::format_args values) { return fmt::vformat(format, values); }

}  // namespace medial_vk
