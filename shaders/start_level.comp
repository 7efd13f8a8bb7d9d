#version 450
#extension GL_GOOGLE_include_directive : enable
// Between levels: the cells kept by the last level become the parents of the next. Between the searches of one level: the
// cells left by the first are those of the second.
#include "gpu_types.h"

layout(local_size_x_id = 0) in;  // 1
layout(constant_id = 1) const uint kSource = kCells;  // or kKept, after a search
layout(constant_id = 2) const bool kSameLevel = false;
layout(set = 0, binding = 0) buffer Counters { uint counters[]; };

void main() {
  if (kSameLevel) {
    counters[kCells] = counters[kSource];
    counters[kKept] = 0u;
    counters[kLines] = 0u;
    return;
  }
  counters[kParents] = counters[kSource];
  counters[kLongestParentList] = counters[kLongestCellList];
  counters[kLongestCellList] = 0u;
  counters[kCells] = 0u;
  counters[kKept] = 0u;
  counters[kLines] = 0u;
}
