// The page of a motion that the build has bundled: src/page/motion/ and its drawing library, in one file without data.
#pragma once

#include <string_view>

namespace medial_vk::page {

/// Empty if the build had no npm, as embedded_page() is. Otherwise split() (output/page/page_parts.h) divides it.
std::string_view embedded_motion();

}  // namespace medial_vk::page
