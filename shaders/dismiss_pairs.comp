#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Cells that are kept because no axis obeys all contacts: is there any pair of carriers that can hold the spokes of a
// salient point (docs/theory.md, theorem on pairs)? If not the cell is empty. If so, the pairs that tie nearest to the
// boundary say where to aim (equation 2.11). One workgroup per cell.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 7
#include "triangles.glsl"

layout(set = 0, binding = 1) buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Links { TriangleLinks links[]; };
layout(set = 0, binding = 5) readonly buffer CornerCones { vec4 corner_cones[]; };
layout(set = 0, binding = 6) writeonly buffer Aims { Aim aims[]; };
#include "pair_queue.glsl"

shared uint is_feasible;

const float kParallel = 0.98;  // cosine above which aims at the same place count as one
const float kNoAim = 3e38;
const uint kNoPair = 0xffffffffu;
const uint kAimSlots = 32u;

// The best pair of every kAimSlots-th: its key (as bits; no key is negative), and the pair, the first where keys tie.
shared uint slot_key[kAimSlots];
shared uint slot_pair[kAimSlots];
shared uint slot_settled[kAimSlots];  // the key that the pair belongs to

// Where the plane between two carriers crosses the cell (equation 2.11): at the point nearest to the centre, or, if
// that is outside, towards the corner in its direction.
Aim aim_between(uint i, uint j, float half_side) {
  vec4 a = carrier_nearest[i], b = carrier_nearest[j];
  vec3 across = b.xyz - a.xyz;
  float turn = length(across), offset = b.w - a.w;
  float extent = half_side * dot(abs(across), vec3(1.0));
  if (turn < 0.1 || abs(offset) > 1.2 * extent) return Aim(vec4(0.0, 0.0, 0.0, kNoAim), vec4(0.0));
  vec3 base = across * (offset / (turn * turn));
  if (any(greaterThan(abs(base), vec3(half_side))))
    base = clamp(offset / extent, -1.0, 1.0) * half_side * mix(vec3(-1.0), vec3(1.0), greaterThan(across, vec3(0.0)));
  float away = max(0.0, max(a.w - dot(a.xyz, base), b.w - dot(b.xyz, base)));
  return Aim(vec4(base, away), vec4(across / turn, 1.0));
}

bool is_same(Aim a, Aim b) {
  return abs(dot(a.direction.xyz, b.direction.xyz)) > kParallel &&
         distance(a.base.xyz, b.base.xyz) < 0.2 * step.cell_size;
}

// The best aims of the slots, different ones.
void choose_aims(uint cell) {
  Aim chosen[kAimsPerCell];
  uint count = 0;
  for (; count < kAimsPerCell; ++count) {
    Aim best = Aim(vec4(0.0, 0.0, 0.0, kNoAim), vec4(0.0));
    for (uint slot = 0; slot < kAimSlots; ++slot) {
      if (slot_pair[slot] == kNoPair || uintBitsToFloat(slot_key[slot]) >= best.base.w) continue;
      uvec2 pair = pair_at(slot_pair[slot]);
      Aim aim = aim_between(carrier_order[pair.x], carrier_order[pair.y], step.half_side);
      bool skip = false;
      for (uint k = 0; k < count; ++k) skip = skip || is_same(aim, chosen[k]);
      if (!skip) best = aim;
    }
    if (best.base.w == kNoAim) break;
    chosen[count] = best;
    aims[kAimsPerCell * cell + count] = best;
  }
  for (uint k = count; k < kAimsPerCell; ++k) aims[kAimsPerCell * cell + k] = Aim(vec4(0.0), vec4(0.0));
}

// One pass over the queue: puts feasible pairs into their slots. A pair that is no better than a feasible one in its
// slot need not be asked.
void rate_queue(float theta, float sine, Box box) {
  for (uint q = gl_LocalInvocationID.x; q < queue_count; q += gl_WorkGroupSize.x) {
    uint slot = queue[q] % kAimSlots;
    uvec2 pair = queued(q);
    uint key = floatBitsToUint(aim_between(pair.x, pair.y, step.half_side).base.w);
    // Ties are asked, so that the choice between them does not depend on who comes first.
    bool needed = is_feasible == 0u || (key <= slot_key[slot] && key != floatBitsToUint(kNoAim));
    if (!needed || !is_feasible_pair(pair.x, pair.y, theta, sine, box)) {
      queue[q] = kNoPair;
      continue;
    }
    atomicOr(is_feasible, 1u);
    atomicMin(slot_key[slot], key);
  }
}

void clear_improved_slots() {
  for (uint slot = gl_LocalInvocationID.x; slot < kAimSlots; slot += gl_WorkGroupSize.x) {
    if (slot_key[slot] == slot_settled[slot]) continue;
    slot_settled[slot] = slot_key[slot];
    slot_pair[slot] = kNoPair;
  }
}

void settle_slots() {
  for (uint q = gl_LocalInvocationID.x; q < queue_count; q += gl_WorkGroupSize.x) {
    if (queue[q] == kNoPair) continue;
    uint slot = queue[q] % kAimSlots;
    uvec2 pair = queued(q);
    uint key = floatBitsToUint(aim_between(pair.x, pair.y, step.half_side).base.w);
    if (key == slot_key[slot]) atomicMin(slot_pair[slot], queue[q]);
  }
}

void main() {
  uint index = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint lane = gl_LocalInvocationID.x;
  bool exists = index < counters[kCells];
  Cell cell = cells[exists ? index : 0u];
  if (!exists) cell.list_count = 0u;
  Box box = Box(cell_centre(uvec3(cell.x, cell.y, cell.z)), vec3(step.half_side), step.circumradius);
  bool decided = gather_carriers(cell, box);
  float d0 = length(vector_to_triangle(box.centre, load_triangle(cell.nearest)));
  float theta = threshold_angle(d0, box), sine = sin(theta - kAngleSlack);
  for (uint slot = lane; slot < kAimSlots; slot += gl_WorkGroupSize.x) {
    slot_key[slot] = floatBitsToUint(kNoAim);
    slot_settled[slot] = slot_key[slot];
    slot_pair[slot] = kNoPair;
  }
  if (lane == 0u) is_feasible = 0u;
  if (decided) {
    for (uint first = 0; first < pair_count(); first += kQueueSize) {
      queue_pairs(first, theta);
      rate_queue(theta, sine, box);
      barrier();
      clear_improved_slots();
      barrier();
      settle_slots();
    }
  }
  barrier();
  if (lane != 0u || !exists) return;
  choose_aims(index);
  if (!decided || is_feasible != 0u) return;
  cells[index].flags |= kCellEmpty;
  atomicAdd(counters[kStatistics + kStatisticsPerLevel * step.level + 1], 0xffffffffu);
}
