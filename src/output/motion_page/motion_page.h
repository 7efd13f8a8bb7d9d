// A page that plays a motion in a browser: one self-contained HTML file, which works from disk and makes no requests.
#pragma once

#include <string>

#include "common/up_axis.h"
#include "output/motion_files/motion_record.h"

namespace medial_vk {

/// The frames that have vertices, each with its mesh and its balls, and the numbers of all frames (docs/viewer.md, "The
/// page of a motion"). Without such a frame the page holds the numbers alone. All frames with vertices have the same
/// number of them, and the triangles refer to these. The same record gives the same bytes. `up` is the initial axis;
/// the page can change it. Call only if check_page_available() (output/page/page.h) is ok.
std::string encode_motion_page(const MotionRecord& record, UpAxis up = UpAxis::kY);

}  // namespace medial_vk
