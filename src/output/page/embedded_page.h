// The page that the build has bundled: src/page/ and its drawing library, in one file without data.
#pragma once

#include <string_view>

namespace medial_vk::page {

/// Empty if the build had no npm. Otherwise split() (output/page/page_parts.h) divides it.
std::string_view embedded_page();

}  // namespace medial_vk::page
