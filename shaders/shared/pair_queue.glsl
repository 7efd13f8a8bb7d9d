// All pairs of a cell's carriers, shared out to the lanes of its workgroup: the cheap test of all of them fills a queue,
// so that all lanes have work in the expensive ones.
#ifndef MEDIAL_VK_PAIR_QUEUE_GLSL
#define MEDIAL_VK_PAIR_QUEUE_GLSL
#include "carrier_pairs.glsl"

const uint kQueueSize = 1024u;
shared uint queue[kQueueSize];
shared uint queue_count;

uint pair_count() { return kept_count * (max(kept_count, 1u) - 1u) / 2u; }

// The pairs (1, 0), (2, 0), (2, 1), (3, 0)... by their number: places in carrier_order, the second smaller.
uvec2 pair_at(uint p) {
  uint i = uint(0.5 + sqrt(2.0 * float(p) + 0.25));
  i = i * (i - 1u) / 2u > p ? i - 1u : (i + 1u) * i / 2u <= p ? i + 1u : i;
  return uvec2(i, p - i * (i - 1u) / 2u);
}

// All lanes: queues those of the kQueueSize pairs from `first` on that may turn enough.
void queue_pairs(uint first, float theta) {
  barrier();
  if (gl_LocalInvocationID.x == 0u) queue_count = 0u;
  barrier();
  uint end = min(first + kQueueSize, pair_count());
  for (uint p = first + gl_LocalInvocationID.x; p < end; p += gl_WorkGroupSize.x) {
    uvec2 pair = pair_at(p);
    if (can_turn(carrier_order[pair.x], carrier_order[pair.y], theta)) queue[atomicAdd(queue_count, 1u)] = p;
  }
  barrier();
}

// The carriers of a queued pair.
uvec2 queued(uint q) {
  uvec2 pair = pair_at(queue[q]);
  return uvec2(carrier_order[pair.x], carrier_order[pair.y]);
}

#endif
