// The page of a surface between sites that the build has bundled: src/page/sites/, in one file without data.
#pragma once

#include <string_view>

namespace medial_vk::page {

/// Empty if the build had no npm, as embedded_page() is. Otherwise split() (output/page/page_parts.h) divides it.
std::string_view embedded_sites();

}  // namespace medial_vk::page
