#version 450
#extension GL_GOOGLE_include_directive : enable
// The group counts of all indirect dispatches up to the next one that needs a changed counter. On a CPU one more
// dispatch costs as much as the work of a small one. Before this, counters are changed for another level, if requested.
#include "gpu_types.h"

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push { PrepareConstants prepare; };
layout(set = 0, binding = 0) coherent buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) writeonly buffer Arguments { uint arguments[]; };
layout(set = 0, binding = 2) readonly coherent buffer Stop { uint stop_word; };
layout(set = 0, binding = 3) readonly buffer Table { DispatchConstants table[]; };
// The host may request a stop at any moment, so the word is read once for all rows: kernels that write at positions
// from prefix sums must not run without these sums.
shared uint stop;
#include "lanes/prepare.glsl"

void move_on() {
  uint left = counters[prepare.start == kStartChildren ? kCells : kKept];
  bool again = prepare.start == kStartAgain;
  if (!again) {
    counters[kParents] = left;
    counters[kLongestParentList] = counters[kLongestCellList];
    counters[kLongestCellList] = 0u;
  }
  counters[kCells] = again ? left : 0u;
  counters[kKept] = 0u;
  counters[kLines] = 0u;
}

void wait_for_counters() {
  memoryBarrierBuffer();
  barrier();
}

void main() {
  uint lane = gl_LocalInvocationID.x, end = prepare.first + prepare.count;
  if (lane == 0u) {
    stop = stop_word;
    if (prepare.start != kStartNothing) move_on();
  }
  wait_for_counters();
  for (uint i = prepare.first + lane; i < end; i += gl_WorkGroupSize.x) check_rounds(table[i]);
  wait_for_counters();
  for (uint i = prepare.first + lane; i < end; i += gl_WorkGroupSize.x) write_arguments(table[i]);
}
