#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Cells that are kept because no axis obeys all contacts: is there any pair of carriers that can hold the spokes of a
// salient point (docs/theory.md, theorem on pairs)? If not the cell is empty. If so, no more are asked, and of those that
// no third carrier beats, the ones that tie nearest to the boundary say where to aim. One workgroup per cell.
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

bool is_same(Aim a, Aim b) {
  return abs(dot(a.direction.xyz, b.direction.xyz)) > kParallel &&
         distance(a.base.xyz, b.base.xyz) < 0.2 * step.cell_size;
}

// All lanes: writes the best aims of the lanes, different ones, those nearest to the boundary first.
void write_aims(uint cell, bool exists) {
  bool is_new = best_aim.direction.w > 0.0;
  for (uint k = 0; k < kAimsPerCell; ++k) {
    float least = least_of_lanes(is_new ? best_aim.base.w : kNoAim);
    uint lane = first_lane_with(is_new && best_aim.base.w == least);
    bool is_mine = gl_LocalInvocationID.x == lane;
    Aim next = Aim(sum_of_lanes(is_mine ? best_aim.base : vec4(0.0)),
                   sum_of_lanes(is_mine ? best_aim.direction : vec4(0.0)));
    if (gl_LocalInvocationID.x == 0u && exists) aims[kAimsPerCell * cell + k] = next;
    is_new = is_new && !is_mine && !is_same(best_aim, next);
  }
}

// All lanes: is one of the queued pairs feasible?
bool rate_pairs(float theta, float sine, Box box) {
  for (;;) {
    Carrier a, b;
    bool feasible = take_pair(a, b);
    feasible = feasible && is_feasible_survivor(a, b, theta, sine, box);
    if (or_of_lanes(feasible ? 1u : 0u) != 0u) return true;
    if (!has_enough_queued()) return false;
  }
}

// All lanes: may any pair hold the spokes? Stops at the first that may.
bool find_feasible_pair(float theta, float sine, Box box) {
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
  bool decided = gather_carriers(cell, box);
  float d0 = length(vector_to_triangle(box.centre, load_triangle(cell.nearest)));
  float theta = threshold_angle(d0, box), sine = sin(theta - kAngleSlack);
  bool is_feasible = true;
  start_pairs();
  if (decided) is_feasible = find_feasible_pair(theta, sine, box);
  write_aims(index, exists);
  if (!exists) return;
  if (lane != 0u || is_feasible) return;
  cells[index].flags |= kCellEmpty;
  COUNT(kKeptCount, 0xffffffffu);
}
