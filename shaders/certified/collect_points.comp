#version 450
#extension GL_GOOGLE_include_directive : enable
// Packs the points of the finest voxels, and the voxels that stay undecided, in the order of the voxels' slots. Run
// twice: first to count the results of every voxel, then, after prefix sums, to write (step.second_task).
#include "certified/step.glsl"

layout(set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer Winners { uint winners[]; };
layout(set = 0, binding = 2) buffer States { uvec4 states[]; };
layout(set = 0, binding = 3) readonly buffer Offsets { uvec4 offsets[]; };
layout(set = 0, binding = 4) readonly buffer Points { FoundPoint points[]; };
layout(set = 0, binding = 5) writeonly buffer Result { FoundPoint result[]; };
layout(set = 0, binding = 6) readonly buffer Voxels { Cell voxels[]; };
layout(set = 0, binding = 7) readonly buffer Reasons { uvec2 reasons[]; };
layout(set = 0, binding = 8) writeonly buffer UndecidedCells { UndecidedCell undecided[]; };
layout(set = 0, binding = 9) readonly buffer GivenUp { uint given_up[]; };

UndecidedCell describe(uint index) {
  Cell voxel = voxels[index];
  uvec2 reason = reasons[index];
  if (reason.x == 0u) reason = uvec2(kOtherReason + 1u, floatBitsToUint(2.0));  // not classified: wider than the box
  return UndecidedCell(voxel.x, voxel.y, voxel.z, reason.x - 1u, uintBitsToFloat(reason.y), 0u, 0u, 0u);
}

void main() {
  uint index = invocation_index();
  if (index >= counters[kVoxels]) return;
  if (step.second_task != 0u) {
    if (states[index].y != 0u) undecided[offsets[index].y] = describe(index);
    if (states[index].x != 0u) result[offsets[index].x] = points[index];
    return;
  }
  bool found = winners[index] != kNoWinner;
  states[index] = uvec4(found ? 1u : 0u, found ? 0u : given_up[index] >> 31, 0u, 0u);
}
