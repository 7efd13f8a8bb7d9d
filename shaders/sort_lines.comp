#version 450
#extension GL_GOOGLE_include_directive : enable
// Invocations that walk together wait for the one whose list is longest. So the lines of a level are asked in another
// order: in blocks of 1024, by how many contacts they ask, those with most first. Proposed lines ask the lists of their
// cells; seeds without a line come last. As the second task, lines that are narrowed: they ask what is left in their
// masks. Every answer goes to a place of its own, so that the order changes nothing else, and equals may come in any.
#include "step.glsl"

layout(set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 3) readonly buffer Lines { Line lines[]; };
layout(set = 0, binding = 4) readonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 5) writeonly buffer Order { uint order[]; };

const uint kClasses = 128u;
shared uint places[kClasses];

uint contacts_of_seed(uint item) {
  if (points[2u * item].w < 0.0) return 0u;
  return line_list_count(cells[item / step.lines_per_cell]);
}

uint contacts_of_line(uint item) {
  Line line = lines[item];
  Cell cell = cells[line.cell];
  uint begin = line_mask_begin(cell, line.seed), end = begin + (line_list_count(cell) + 31u) / 32u, count = 0u;
  for (uint w = begin; w < end; ++w) count += bitCount(masks[w]);
  return count;
}

// Eight classes for every power of two, most first.
uint class_of(uint count) {
  if (count == 0u) return kClasses - 1u;
  uint power = uint(findMSB(count));
  return kClasses - 2u - min(8u * power + (count << 3u >> power & 7u), kClasses - 2u);
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint block = kSortedPerLane * (invocation_index() - lane);
  uint count = step.second_task != 0u ? counters[kLines] : step.lines_per_cell * counters[kCells];
  for (uint c = lane; c < kClasses; c += gl_WorkGroupSize.x) places[c] = 0u;
  barrier();
  uint classes[kSortedPerLane], before[kSortedPerLane];
  uint items = min(count - min(count, block), kSortedPerLane * gl_WorkGroupSize.x);
  for (uint k = 0u, i = lane; i < items; ++k, i += gl_WorkGroupSize.x) {
    classes[k] = class_of(step.second_task != 0u ? contacts_of_line(block + i) : contacts_of_seed(block + i));
    before[k] = atomicAdd(places[classes[k]], 1u);
  }
  barrier();
  if (lane == 0u) {
    uint sum = 0u;
    for (uint c = 0u; c < kClasses; ++c) {
      uint number = places[c];
      places[c] = sum;
      sum += number;
    }
  }
  barrier();
  for (uint k = 0u, i = lane; i < items; ++k, i += gl_WorkGroupSize.x)
    order[block + places[classes[k]] + before[k]] = block + i;
}
