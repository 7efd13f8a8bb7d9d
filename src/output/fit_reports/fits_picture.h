// A picture of the spheres of a mesh or of a whole robot.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "medial_vk/result.h"
#include "output/fit_reports/fits_record.h"
#include "output/picture/panels/options.h"
#include "robots/model/robot.h"

namespace medial_vk {

/// The pose of the link of each part, with all joints at zero.
std::vector<Pose> part_poses(const Robot& robot, std::span<const Part> parts);

/// The bytes of a PNG: the union of the spheres of the last level, coloured by radius; `poses` are those of the links
/// of the parts. Without a device the CPU draws. Error: kOutOfMemory.
Result<std::string> encode_fits_picture(const FitsRecord& record, std::span<const Pose> poses, const PictureView& view,
                                        const DeviceDescription* device);

}  // namespace medial_vk
