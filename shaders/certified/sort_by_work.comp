#version 450
#extension GL_GOOGLE_include_directive : enable
// Invocations that walk together wait for the one with the most work. Lines and groups of flux samples are therefore
// processed in another order: in blocks of 1024, those with the most contacts first, those without any last. Every
// result has its own slot, so the order changes nothing else, and equal items may come in any order. Of flux samples
// (its second task) it counts the distances, for all groups together; the kernel that evaluates lines counts them
// itself.
#include "certified/step.glsl"

layout(set = 0, binding = 0) buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer Work { uint work[]; };  // number of contacts that an item reads
layout(set = 0, binding = 2) writeonly buffer Order { uint order[]; };

const uint kClasses = 128u;
shared uint positions[kClasses];

// Eight classes for every power of two, most first.
uint class_of(uint contacts) {
  uint power = uint(max(findMSB(contacts), 0));
  uint rising = min(1u + 8u * power + (contacts << 3u >> power & 7u), kClasses - 1u);
  return kClasses - 1u - (contacts == 0u ? 0u : rising);
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint block = kSortedPerLane * (invocation_index() - lane);
  uint all = counters[step.items_counter] * step.items_multiplier;
  uint left = all - min(all, step.first_item + block);
  uint items = min(left, kSortedPerLane * gl_WorkGroupSize.x);
  for (uint c = lane; c < kClasses; c += gl_WorkGroupSize.x) positions[c] = 0u;
  barrier();
  // Eight invocations process a run of items: if they are one vector, the items of a class keep their order.
  uint first = kSortedPerLane * (lane & ~7u) + (lane & 7u);
  uint rank[kSortedPerLane];  // class and, above it, number in the class
  uint contacts = 0u;
  for (uint k = 0u, i = first; k < kSortedPerLane && i < items; ++k, i += 8u) {
    contacts += work[block + i];
    uint c = class_of(work[block + i]);
    rank[k] = c + kClasses * atomicAdd(positions[c], 1u);
  }
  if (step.second_task != 0u) COUNT_TESTS(kFluxGroup * contacts);
  barrier();
  if (lane == 0u) {
    uint sum = 0u;
    for (uint c = 0u; c < kClasses; ++c) {
      uint number = positions[c];
      positions[c] = sum;
      sum += number;
    }
  }
  barrier();
  for (uint k = 0u, i = first; k < kSortedPerLane && i < items; ++k, i += 8u)
    order[block + positions[rank[k] % kClasses] + rank[k] / kClasses] = block + i;
}
