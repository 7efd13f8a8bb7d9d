#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Cells that are kept because no axis obeys all contacts: is there any pair of carriers that can hold the spokes of a
// salient point (docs/theory.md, theorem on pairs)? If not the cell is empty. If so, the pairs of the nearest carriers
// say where to aim (equation 2.11), and no more are asked. One workgroup per cell.
#include "lanes.glsl"
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

const float kParallel = 0.98;  // cosine above which aims at the same place count as one
shared Aim chosen[kAimsPerCell];
uint aim_count;  // the same in all lanes

// Where the plane between two carriers crosses the cell (equation 2.11): at the point nearest to the centre, or, if
// that is outside, towards the corner in its direction. Direction w is 0 where it does not cross.
Aim aim_between(vec4 a, vec4 b, float half_side) {
  vec3 across = b.xyz - a.xyz;
  float turn = length(across), offset = b.w - a.w;
  float extent = half_side * dot(abs(across), vec3(1.0));
  if (turn < 0.1 || abs(offset) > 1.2 * extent) return Aim(vec4(0.0), vec4(0.0));
  vec3 base = across * (offset / (turn * turn));
  if (any(greaterThan(abs(base), vec3(half_side))))
    base = clamp(offset / extent, -1.0, 1.0) * half_side * mix(vec3(-1.0), vec3(1.0), greaterThan(across, vec3(0.0)));
  return Aim(vec4(base, 0.0), vec4(across / turn, 1.0));
}

bool is_same(Aim a, Aim b) {
  return abs(dot(a.direction.xyz, b.direction.xyz)) > kParallel &&
         distance(a.base.xyz, b.base.xyz) < 0.2 * step.cell_size;
}

// All lanes, each with an aim or none: chooses those that differ from all chosen before, in the order of the lanes.
void choose_aims(Aim aim) {
  bool is_new = aim.direction.w > 0.0;
  for (uint k = 0; k < aim_count; ++k) is_new = is_new && !is_same(aim, chosen[k]);
  for (;;) {
    uint first = first_lane_with(is_new);
    if (first == kLanes || aim_count == kAimsPerCell) break;
    if (gl_LocalInvocationID.x == first) chosen[aim_count] = aim;
    synchronize();
    is_new = is_new && gl_LocalInvocationID.x != first && !is_same(aim, chosen[aim_count]);
    ++aim_count;
  }
}

// All lanes: takes queued pairs, and from each that is feasible an aim. Returns whether any is.
bool rate_pairs(float theta, float sine, Box box) {
  for (;;) {
    Carrier a, b;
    bool feasible = take_pair(a, b);
    feasible = feasible && is_feasible_survivor(a, b, theta, sine, box);
    Aim aim = aim_between(a.nearest, b.nearest, step.half_side);
    aim.direction.w = feasible ? aim.direction.w : 0.0;
    choose_aims(aim);
    uint lanes = or_of_lanes(feasible ? 1u : 0u);
    if (lanes != 0u) return true;
    if (!has_enough_queued()) return false;
  }
}

// All lanes: more aims, from what is queued. The tests that are left reject few pairs: they are not asked.
void choose_more_aims() {
  while (aim_count < kAimsPerCell && queue_head < queue_tail) {
    Carrier a, b;
    bool exists = take_pair(a, b);
    Aim aim = aim_between(a.nearest, b.nearest, step.half_side);
    aim.direction.w = exists ? aim.direction.w : 0.0;
    choose_aims(aim);
  }
}

// All lanes: may any pair hold the spokes? Stops at the first that may.
bool find_feasible_pair(float theta, float sine, Box box) {
  start_pairs();
  if (!has_more_blocks()) return false;
  for (;;) {
    fill_queue(theta, box);
    if (rate_pairs(theta, sine, box)) return true;
    if (!has_more_blocks()) return false;
  }
}

void main() {
  uint index = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint lane = gl_LocalInvocationID.x;
  bool exists = index < counters[kCells];
  Cell cell = cells[exists ? index : 0u];
  if (!exists) cell.touching = 0u;
  Box box = Box(cell_centre(uvec3(cell.x, cell.y, cell.z)), vec3(step.half_side), step.circumradius);
  aim_count = 0u;
  bool decided = gather_carriers(cell, box);
  float d0 = length(vector_to_triangle(box.centre, load_triangle(cell.nearest)));
  float theta = threshold_angle(d0, box), sine = sin(theta - kAngleSlack);
  bool is_feasible = true;
  if (decided) {
    is_feasible = find_feasible_pair(theta, sine, box);
    choose_more_aims();
  }
  if (!exists) return;
  if (lane < kAimsPerCell) {
    bool is_chosen = lane < aim_count;
    aims[kAimsPerCell * index + lane].base = is_chosen ? chosen[lane].base : vec4(0.0);
    aims[kAimsPerCell * index + lane].direction = is_chosen ? chosen[lane].direction : vec4(0.0);
  }
  if (lane != 0u || is_feasible) return;
  cells[index].flags |= kCellEmpty;
  atomicAdd(counters[kStatistics + kStatisticsPerLevel * step.level + 1], 0xffffffffu);
}
