// The pairs of a cell's carriers, the nearest first, in an order that does not depend on the device. Pairs that pass
// the fast tests are queued, so that all lanes have work in the slow ones. All lanes call these functions.
//
// Loops with slow bodies test their condition at the end, since a CPU otherwise runs the body for all lanes before it
// tests whether any of them needed it. The condition at their start always holds (docs/reliability.md, "Values that
// leave a loop").
#ifndef MEDIAL_VK_PAIR_QUEUE_GLSL
#define MEDIAL_VK_PAIR_QUEUE_GLSL
#include "certified/aim.glsl"
#include "certified/carrier_pairs.glsl"

const uint kQueueSize = 256u;  // a power of two, above kLanes + 3 kLanes^2
shared uint queue[kQueueSize];  // two slots of carriers, modulo its size
// The same in all lanes: the begin and the end of the queue, and the next block of pairs: those of a row with an
// earlier row, or within one row.
uint queue_head, queue_tail, next_row, next_other_row;

Aim best_aim;  // of the pairs that this lane has queued: the one with the tie closest to the boundary

void start_pairs() {
  queue_head = 0u;
  queue_tail = 0u;
  next_row = 0u;
  next_other_row = 0u;
  best_aim = Aim(vec4(0.0, 0.0, 0.0, kNoAim), vec4(0.0));
}

bool has_more_blocks() { return next_row < row_count(kept_count); }

// The carriers of a row of carrier_order, one per lane; lanes beyond the end hold the last one.
Carrier load_row(uint row, out uint slot) {
  slot = carrier_order[min(kLanes * row + gl_LocalInvocationID.x, kept_count - 1u)];
  return load_carrier(slot);
}

// The partners of this lane's carrier that may turn enough with it; bit r: partner (lane + r) % 8 of the other row.
// Within a row each pair is met once: at distances 1 to 3, and at 4 from the first half.
uint turning_partners(Carrier mine, Carrier row, float theta) {
  uint lane = gl_LocalInvocationID.x;
  bool is_same_row = next_row == next_other_row;
  bool exists = kLanes * next_row + lane < kept_count;
  uint mask = 0u;
  for (uint r = is_same_row ? 1u : 0u; r < (is_same_row ? 5u : kLanes); ++r) {
    uint k = (lane + r) % kLanes;
    Carrier other = CARRIER_OF_LANE(row, carrier_order, kept_count, kLanes * next_other_row, k);
    bool is_pair = !is_same_row || r < 4u || lane < 4u;
    bool is_other = kLanes * next_other_row + k < kept_count, turns = can_turn(mine, other, theta);
    mask |= is_pair && exists && is_other && turns ? 1u << r : 0u;
  }
  return mask;
}

// The partners among them that no third carrier beats.
uint unbeaten_partners(uint mask, Carrier mine, Carrier row, Carrier nearest_row, Box box) {
  uint unbeaten = 0u;
  for (; mask != 0u; mask &= mask - 1u) {
    uint r = uint(findLSB(mask));
    uint k = (gl_LocalInvocationID.x + r) % kLanes;
    Carrier other = CARRIER_OF_LANE(row, carrier_order, kept_count, kLanes * next_other_row, k);
    if (is_beaten(mine, other, nearest_row, box)) continue;
    unbeaten |= 1u << r;
    Aim aim = aim_between(mine.nearest, other.nearest, step.half_side);
    if (aim.base.w < best_aim.base.w) best_aim = aim;
  }
  return unbeaten;
}

// Queues the survivors of one block.
void queue_block(Carrier nearest_row, float theta, Box box) {
  uint lane = gl_LocalInvocationID.x, slot, other_slot;
  Carrier mine = load_row(next_row, slot);
  Carrier row = load_row(next_other_row, other_slot);
  uint mask = unbeaten_partners(turning_partners(mine, row, theta), mine, row, nearest_row, box);
  uvec2 counted = count_lanes(uint(bitCount(mask)));
  for (uint at = queue_tail + counted.x; mask != 0u; mask &= mask - 1u) {
    uint other = kLanes * next_other_row + (lane + uint(findLSB(mask))) % kLanes;
    queue[at++ % kQueueSize] = slot << 16 | carrier_order[other];
  }
  queue_tail += counted.y;
  bool is_last = next_other_row == next_row;
  next_row += is_last ? 1u : 0u;
  next_other_row = is_last ? 0u : next_other_row + 1u;
  synchronize();
}

// Queues pairs until there is one for every lane or none is left. Below the finest level, where cells are few and hard,
// it continues until the sixteen nearest carriers have been paired as well, which improves the aims.
void fill_queue(float theta, Box box) {
  uint slot;
  Carrier nearest_row = load_row(0u, slot);
  while (has_more_blocks()) {
    queue_block(nearest_row, theta, box);
    bool enough = queue_tail - queue_head >= kLanes && (step.depth == 0u || next_row >= 2u);
    if (enough || !has_more_blocks()) break;
  }
}

// Each lane takes one pair; false: there is none for it.
bool take_pair(out Carrier a, out Carrier b) {
  uint at = queue_head + gl_LocalInvocationID.x;
  bool exists = at < queue_tail;
  uint pair = exists ? queue[at % kQueueSize] : 0u;
  a = load_carrier(pair >> 16);
  b = load_carrier(pair & 0xffffu);
  queue_head = min(queue_head + kLanes, queue_tail);
  return exists;
}

// The carrier of lane k in the pairs that were taken from `head` on: of the half-word `shift` of the queue.
#ifdef LOCKSTEP
#define QUEUED_CARRIER(mine, head, k, shift) \
  Carrier(from_lane(mine.name, k), from_lane(mine.nearest, k), from_lane(mine.spokes, k))
#else
#define QUEUED_CARRIER(mine, head, k, shift) load_carrier(queue[((head) + (k)) % kQueueSize] >> (shift) & 0xffffu)
#endif

// True if pairs should be taken now rather than more of them queued.
bool has_enough_queued() {
  uint queued = queue_tail - queue_head;
  return queued >= kLanes || (queued > 0u && !has_more_blocks());
}

#endif
