#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Cells that the search leaves: what must a salient medial point that hides there be like (docs/theory.md, "What
// undecided means")? The pairs of carriers that remain bound its width (equation 3.1), and the same test on the part of
// the cell away from the faces of its voxel, or with a larger angle, says why it could not be settled. One workgroup
// per cell; a voxel takes the gravest reason and the largest width of its cells. Above the last level only cells that can
// hide nothing else are given up; the others are left to be subdivided.
#include "lanes.glsl"
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 8
#include "triangles.glsl"

layout(set = 0, binding = 1) buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Links { TriangleLinks links[]; };
layout(set = 0, binding = 5) readonly buffer CornerCones { vec4 corner_cones[]; };
layout(set = 0, binding = 6) readonly buffer Verdicts { uint verdicts[]; };
layout(set = 0, binding = 7) buffer Reasons { uvec2 reasons[]; };  // kind + 1, bits of the width
#include "pair_queue.glsl"

const float kFaceMargin = 1.0 / 64.0;  // of the voxel side
const float kAngleMargin = 0.05;
const float kSettleMargin = 0.02;  // above the last level: what is given up is at least that near the angle
const float kBoundaryRadius = 1.0 / 8.0;  // of the voxel side

// Feet stay within the circumradius of the nearest points to the centre, because projections on convex sets do not
// expand distances; and two spokes of length r that differ by 2 alpha end 2 r sin(alpha) apart.
float pair_width(Carrier a, Carrier b, float nearest_distance, Box box) {
  float rho = box.circumradius + step.slack;
  float by_feet = distance(a.nearest.xyz * a.nearest.w, b.nearest.xyz * b.nearest.w) + 2.0 * rho;
  float turn = acos(clamp(dot(a.spokes.xyz, b.spokes.xyz), -1.0, 1.0)) + a.spokes.w + b.spokes.w + 1e-3;
  float by_turn = 2.0 * (nearest_distance + rho) * sin(min(0.5 * turn, 1.5707964));
  return min(by_feet, by_turn);
}

// What a box may hold: whether its carriers could be listed, whether a pair of them is feasible, and its width.
struct Remains {
  bool decided, feasible;
  float width;
};

// All lanes: all pairs if the width is wanted, else until one is feasible.
Remains what_remains(Cell cell, Box box, float theta, float nearest_distance, bool wants_width) {
  Remains r = Remains(gather_carriers(cell, box), false, 0.0);
  float sine = sin(theta - kAngleSlack);
  start_pairs();
  while (r.decided && has_more_blocks() && (wants_width || !r.feasible)) {
    fill_queue(theta, box);
    while (has_enough_queued()) {
      Carrier a, b;
      bool feasible = take_pair(a, b);
      feasible = feasible && is_feasible_survivor(a, b, theta, sine, box);
      r.width = max(r.width, feasible ? pair_width(a, b, nearest_distance, box) : 0.0);
      r.feasible = or_of_lanes(r.feasible || feasible ? 1u : 0u) != 0u;
    }
  }
  r.width = -least_of_lanes(-r.width);
  return r;
}

// The part of a cell that is farther than the margin from the faces of its voxel.
Box inner_part(Cell cell, Box whole, out bool exists) {
  float margin = kFaceMargin * step.voxel_size;
  vec3 corner = finest_voxel_corner(cell);
  vec3 lower = max(whole.centre - whole.half_sides, corner + margin);
  vec3 upper = min(whole.centre + whole.half_sides, corner + step.voxel_size - margin);
  exists = all(lessThan(lower + 1e-6, upper));  // half sides are rounded up by 3e-7
  vec3 half_sides = 0.5 * (upper - lower);
  return Box(0.5 * (lower + upper), half_sides, length(half_sides));
}

void main() {
  uint index = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint lane = gl_LocalInvocationID.x;
  bool exists = index < counters[kCells];
  Cell cell = cells[exists ? index : 0u];
  bool gives_up = step.last_level != 0u || is_hopeless(cell.flags);
  exists = exists && (cell.flags & kCellEmpty) == 0u && (verdicts[cell.voxel] & kVerdictFound) == 0u &&
           (gives_up || step.settles != 0u);
  if (!exists) cell.touching = 0u;
  Box whole = Box(cell_centre(uvec3(cell.x, cell.y, cell.z)), vec3(step.half_side), step.circumradius);
  float d0 = length(vector_to_triangle(whole.centre, load_triangle(cell.nearest)));
  float theta = threshold_angle(d0, whole);
  bool has_inner;
  Box inner = inner_part(cell, whole, has_inner);
  // Its inner part at a larger angle; its inner part; the whole cell.
  float margin = gives_up ? kAngleMargin : kSettleMargin;
  Remains found[3];
  for (uint k = 0; k < 3u; ++k) {
    Box box = inner;
    if (k == 2u) box = whole;
    found[k] = what_remains(cell, box, k == 0u ? theta + margin : theta, d0, k == 2u);
    if (!gives_up && has_inner && (!found[0].decided || found[0].feasible)) return;
  }
  if (lane != 0u || !exists) return;
  float bound = 2.0 * (d0 + step.circumradius + step.slack);
  float width = found[2].decided ? min(bound, found[2].width) : bound;
  bool close = d0 + step.circumradius <= kBoundaryRadius * step.voxel_size;
  uint kind = close || is_hopeless(cell.flags) ? kAtBoundary : kOtherReason;
  if (found[0].decided && !found[0].feasible) kind = kNearAngle;
  if (!has_inner || (found[1].decided && !found[1].feasible)) kind = kNearFace;
  if (!gives_up) cells[index].flags |= kCellSettled;
  atomicMax(reasons[cell.voxel].x, kind + 1u);
  atomicMax(reasons[cell.voxel].y, floatBitsToUint(width));
}
