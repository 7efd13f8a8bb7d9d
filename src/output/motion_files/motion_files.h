// Balls that followed a mesh as files (docs/formats.md, "Balls in motion"). The same record gives the same bytes.
#pragma once

#include <string>

#include "medial_vk/result.h"
#include "output/motion_files/motion_record.h"

namespace medial_vk {

/// A header line and a line per frame: how much of the solid is in no ball, how far its boundary is from the balls, and
/// how many balls are in which state; of covers, what is proved, how much the balls add, and how far they reach out.
/// Numbers that were not measured are empty.
std::string encode_motion_csv(const MotionRecord& record);

/// NumPy arrays: `balls`, frames x balls x 4 (centre and radius), `states`, and a number per frame for the rest. Error:
/// kOutOfMemory.
Result<std::string> encode_motion_npz(const MotionRecord& record);

/// A scene of glTF 2.0 with a node for each ball and one animation, whose values stay constant until the next frame,
/// because only frames are certified. Balls are rounded such that each lies inside the ball that it represents or, of a
/// cover, holds it. Error: kCannotWrite, if the file would exceed the size limit of its format.
Result<std::string> encode_motion_glb(const MotionRecord& record);

}  // namespace medial_vk
