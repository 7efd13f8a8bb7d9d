// The page of a shape in the plane that the build has bundled: src/page/plane/, in one file without data.
#pragma once

#include <string_view>

namespace medial_vk::page {

/// Empty if the build had no npm, as embedded_page() is. Otherwise split() (output/page/page_parts.h) divides it.
std::string_view embedded_plane();

}  // namespace medial_vk::page
