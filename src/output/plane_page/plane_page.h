// A page that shows a shape in the plane and its medial axis in a browser: one self-contained HTML file, which works
// from disk and makes no requests.
#pragma once

#include <string>

#include "output/plane_files/plane_record.h"

namespace medial_vk {

/// The same record gives the same bytes. Call only if check_page_available() (output/page/page.h) is ok.
std::string encode_plane_page(const PlaneRecord& record);

}  // namespace medial_vk
