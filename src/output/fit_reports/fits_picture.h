// A picture of the spheres of a mesh or of a whole robot.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "medial_vk/part_fits.h"
#include "medial_vk/result.h"
#include "output/fit_reports/fits_record.h"
#include "output/picture/panels/options.h"
#include "robots/model/robot.h"

namespace medial_vk {

/// The pose of the link of each solid, with all joints at zero.
std::vector<Pose> link_poses(const Robot& robot, std::span<const FittedSolid> solids);

/// The bytes of a PNG: the union of the spheres of the last level, coloured by radius; `poses` lead from
/// the frames of the links of the solids to a common one. Without a device the CPU draws. Error: kOutOfMemory.
Result<std::string> encode_fits_picture(const FitsRecord& record, std::span<const Pose> poses, const PictureView& view,
                                        const DeviceDescription* device);

}  // namespace medial_vk
