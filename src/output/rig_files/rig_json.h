// The balls of a skinned mesh as a file for engines (docs/formats.md, "Balls of a rig").
#pragma once

#include <string>

#include "motion_files/mesh_motion.h"
#include "rigs/ball_rig.h"

namespace medial_vk {

struct RigFile {
  std::string version;  ///< Of the program.
  std::string name;     ///< Of the mesh.
  const MotionRig& rig;
  const BallRig& balls;
};

/// JSON. Numbers have the fewest digits that read back as the same doubles.
std::string encode_rig(const RigFile& file);

}  // namespace medial_vk
