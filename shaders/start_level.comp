#version 450
#extension GL_GOOGLE_include_directive : enable
// Between levels: the cells kept by the last level become the parents of the next.
#include "gpu_types.h"

layout(local_size_x_id = 0) in;  // 1
layout(constant_id = 1) const uint kSource = kCells;  // or kKept, after a search
layout(set = 0, binding = 0) buffer Counters { uint counters[]; };

void main() {
  counters[kParents] = counters[kSource];
  counters[kLongestParentList] = counters[kLongestCellList];
  counters[kLongestCellList] = 0u;
  counters[kCells] = 0u;
  counters[kKept] = 0u;
  counters[kLines] = 0u;
}
