// A contact sheet: some frames of balls that follow a mesh, side by side in the same view.
#pragma once

#include "output/motion_files/motion_record.h"
#include "output/picture/panels/image.h"
#include "output/picture/panels/options.h"

namespace medial_vk {

/// The greatest number of frames in a contact sheet.
constexpr std::size_t kMostMotionPictures = 12;

/// The frames that have vertices, row by row, at most kMostMotionPictures of them, evenly chosen with the first and the
/// last; 480 x 400 pixels each. The colours of the balls show their states. Precondition: a frame has vertices.
Picture draw_motion(const MotionRecord& record, const PictureView& view);

}  // namespace medial_vk
