// A picture of a shape in the plane with its medial axis.
#pragma once

#include "output/picture/panels/image.h"
#include "output/plane_files/plane_record.h"

namespace medial_vk {

/// The shape as glass, the branches in colours with a legend, some medial discs, junctions and ends, and numbers below:
/// 1600 pixels wide, 600 to 1500 high. Drawn on the CPU, on one thread.
Picture draw_plane(const PlaneRecord& record);

}  // namespace medial_vk
