// The page that the build has bundled: src/page/ and its drawing library, in one file without data.
#pragma once

#include <string_view>

namespace medial_vk::page {

/// Empty if the build had no npm. Holds the marks kTitleMark and kDataMark once each (cmake/BundlePage.cmake).
std::string_view embedded_page();

inline constexpr std::string_view kTitleMark = "<!--medial-vk: title-->";
inline constexpr std::string_view kDataMark = "<!--medial-vk: data-->";

}  // namespace medial_vk::page
