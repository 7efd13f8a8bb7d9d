#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Decides whether any pair of carriers of a cell can hold the spokes of a salient point (docs/theory.md, theorem on
// pairs). One workgroup per cell. One program has both tasks, since a driver takes long to translate it.
//
// Before the search, it examines cells that are kept because no axis obeys all contacts: if there is no such pair, the
// cell is empty. If there is one, the search for pairs ends, and of the pairs that no third carrier beats, those with a
// tie nearest to the boundary determine the aims.
//
// After the search (step.second_task), it examines the cells that remain, to bound the salient medial points that may
// be hidden there (docs/theory.md, "What undecided means"). The remaining pairs bound the width (equation 3.1), and the
// same test on the part of the cell away from the faces of its voxel, or with a larger angle, gives the reason why it
// could not be settled. A voxel receives the gravest reason and the largest width of its cells. Above the last level,
// only cells that can hold no other points are given up; the others are subdivided.
#include "lanes/lanes.glsl"
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 10
#include "tree/triangles.glsl"

layout(set = 0, binding = 1) buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
#define LINK_STORAGE_BINDING 4
#define CORNER_STORAGE_BINDING 5
#define LINK_TEXEL_BINDING 11
#define CORNER_TEXEL_BINDING 12
#include "certified/links.glsl"
layout(set = 0, binding = 6) writeonly buffer Aims { Aim aims[]; };
layout(set = 0, binding = 7) readonly buffer Winners { uint winners[]; };
layout(set = 0, binding = 8) buffer Reasons { uvec2 reasons[]; };  // kind + 1, bits of the width
layout(set = 0, binding = 9) readonly buffer GivenUp { uint given_up[]; };  // kGivenUpBit
#include "certified/pair_queue.glsl"
#include "certified/joint_conditions.glsl"
#include "certified/foot_sides.glsl"

const float kFaceMargin = 1.0 / 64.0;  // of the voxel side
const float kAngleMargin = 0.05;
const float kSettleMargin = 0.02;  // radians: the same margin above the last level, where cells are given up early
const uint kMostCells = 256u;  // of a voxel, before they may be given up above the last level
const float kBoundaryRadius = 1.0 / 8.0;  // of the voxel side

// Limit of the rounds over queued pairs of an invocation: some 70 iterations each where directions at corners are
// tested, 16 elsewhere, of the 65,535 after which lavapipe ends all loops (tree.glsl); filling the queue and gathering
// carriers take up to 24,000. Cells with more pairs are kept.
const uint kMostRounds = kHasUntrusted ? 448u : 1984u;
uint rounds = 0u;
// Of the pairs whose conditions are tested together (joint_conditions.glsl): some 70 iterations each.
const uint kMostJoint = 128u;
uint joint_tests = 0u;

const float kParallel = 0.98;  // cosine above which aims at the same point count as one

bool is_same(Aim a, Aim b) {
  return abs(dot(a.direction.xyz, b.direction.xyz)) > kParallel &&
         distance(a.base.xyz, b.base.xyz) < 0.2 * step.cell_size;
}

// For all lanes: writes the best aims of the lanes, without repetition, the nearest to the boundary first.
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

// Feet stay within the circumradius of the nearest points to the centre, because projections on convex sets do not
// expand distances; and two spokes of length r that differ by 2 alpha end 2 r sin(alpha) apart.
float pair_width(Carrier a, Carrier b, float nearest_distance, Box box) {
  float rho = box.circumradius + step.slack;
  float by_feet = distance(a.nearest.xyz * a.nearest.w, b.nearest.xyz * b.nearest.w) + 2.0 * rho;
  float turn = acos(clamp(dot(a.spokes.xyz, b.spokes.xyz), -1.0, 1.0)) + a.spokes.w + b.spokes.w + 1e-3;
  float by_turn = 2.0 * (nearest_distance + rho) * sine(min(0.5 * turn, 1.5707963));
  return min(by_feet, by_turn);
}

// Result for a box: whether its carriers could be listed, whether a pair of them is feasible, and its width.
struct Remains {
  bool decided, feasible;
  float width;
};

// For all lanes: tests the pairs that `lanes` have taken, queued from `head` on, one after the other, until the conditions
// of one can hold together. Returns the lanes whose pairs are not excluded or not tested. The point of that pair, if
// there is one, becomes an aim.
uint joint_lanes(uint lanes, uint head, Carrier mine_a, Carrier mine_b, float theta, Box box) {
  uint left = lanes, slot;
  Carrier rival = load_row(0u, slot);
  while (left != 0u) {
    uint lane = uint(findLSB(left));
    Carrier a = QUEUED_CARRIER(mine_a, head, lane, 16u), b = QUEUED_CARRIER(mine_b, head, lane, 0u);
    vec4 point;
    vec3 across;
    bool can = can_be_joint(a, b, rival, theta, box, point, across);
    float size = length(across);
    if (gl_LocalInvocationID.x == lane && can && point.w > 0.0 && size > 0.1)
      best_aim = Aim(vec4(point.xyz, -1.0), vec4(across / size, 1.0));
    left &= can ? left : left - 1u;
    if (can || left == 0u || ++joint_tests > kMostJoint) break;
  }
  return left;
}

// For all lanes: evaluates the queued pairs, or, if the width is not needed, stops at the first feasible one.
void rate_pairs(inout Remains r, Cell cell, float theta, float sine, float nearest_distance, bool wants_width, Box box) {
  while (r.decided) {
    Carrier a, b;
    uint head = queue_head, lane = gl_LocalInvocationID.x;
    bool feasible = take_pair(a, b);
    feasible = feasible && is_feasible_survivor(a, b, theta, sine, box);
    if (kHasUntrusted) feasible = feasible && !is_outside_pair(a.name, b.name, cell, nearest_distance);
    uint lanes = or_of_lanes(feasible ? 1u << lane : 0u);
    if (!wants_width && lanes != 0u && joint_tests <= kMostJoint) lanes = joint_lanes(lanes, head, a, b, theta, box);
    r.width = max(r.width, feasible ? pair_width(a, b, nearest_distance, box) : 0.0);
    r.feasible = r.feasible || lanes != 0u;
    r.decided = r.decided && ++rounds <= kMostRounds;
    if (!has_enough_queued() || !r.decided || (r.feasible && !wants_width)) break;
  }
}

// For all lanes.
Remains what_remains(Cell cell, Box box, float theta, float nearest_distance, bool wants_width) {
  Remains r = Remains(gather_carriers(cell, box), false, 0.0);
  float sine_of_angle = sine(theta - kAngleSlack);
  start_pairs();
  while (r.decided && has_more_blocks()) {
    fill_queue(theta, box);
    rate_pairs(r, cell, theta, sine_of_angle, nearest_distance, wants_width, box);
    if (!has_more_blocks() || !r.decided || (r.feasible && !wants_width)) break;
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

void dismiss(uint index, bool exists, Remains whole) {
  write_aims(index, exists);
  if (!exists || gl_LocalInvocationID.x != 0u || whole.feasible || !whole.decided) return;
  cells[index].flags |= kCellEmpty;
  COUNT(kKeptCount, 0xffffffffu);
}

// `narrower`: of the inner part at a larger angle; `inside`: of the inner part.
void classify(uint index, Cell cell, float d0, bool has_inner, Remains narrower, Remains inside, Remains whole) {
  bool gives_up = (step.ends & kEndsAll) != 0u || is_hopeless(cell.flags);
  float bound = 2.0 * (d0 + step.circumradius + step.slack);
  float width = whole.decided ? min(bound, whole.width) : bound;
  bool close = d0 + step.circumradius <= kBoundaryRadius * step.voxel_size;
  uint kind = close || is_hopeless(cell.flags) ? kAtBoundary : kOtherReason;
  if (narrower.decided && !narrower.feasible) kind = kNearAngle;
  if (!has_inner || (inside.decided && !inside.feasible)) kind = kNearFace;
  if (!gives_up) cells[index].flags |= kCellSettled;
  atomicMax(reasons[cell.voxel].x, kind + 1u);
  atomicMax(reasons[cell.voxel].y, ordered_bits(width));
}

void main() {
  uint index = step.first_item + workgroup_index();
  bool exists = index < counters[kCells], classifies = step.second_task != 0u;
  Cell cell = cells[exists ? index : 0u];
  bool gives_up = (step.ends & kEndsAll) != 0u || is_hopeless(cell.flags);
  if (classifies) {
    exists = exists && (cell.flags & kCellEmpty) == 0u && winners[cell.voxel] == kNoWinner &&
             (gives_up || ((step.ends & kEndsSettled) != 0u && given_up[cell.voxel] > kMostCells));
  }
  if (!exists) cell.touching = 0u;
  Box whole = Box(cell_centre(uvec3(cell.x, cell.y, cell.z)), vec3(step.half_side), step.circumradius);
  float d0 = length(vector_to_triangle(whole.centre, load_triangle(cell.nearest)));
  float theta = threshold_angle(d0, whole), margin = gives_up ? kAngleMargin : kSettleMargin;
  bool has_inner;
  Box inner = inner_part(cell, whole, has_inner);
  Remains narrower, inside, last;
  // The inner part at a larger angle; the inner part; the whole cell. Most cells are not classified, and skip all.
  for (uint k = !exists ? 3u : classifies ? 0u : 2u; k < 3u;) {
    Box box = inner;
    if (k == 2u) box = whole;
    last = what_remains(cell, box, k == 0u ? theta + margin : theta, d0, classifies && k == 2u);
    if (k == 0u) narrower = last;
    if (k == 1u) inside = last;
    bool may_hide_more = classifies && !gives_up && has_inner && (!narrower.decided || narrower.feasible);
    if (may_hide_more) return;
    if (++k == 3u) break;
  }
  if (!classifies)
    dismiss(index, exists, last);
  else if (exists && gl_LocalInvocationID.x == 0u)
    classify(index, cell, d0, has_inner, narrower, inside, last);
}
