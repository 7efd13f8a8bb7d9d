#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// Aims at the sheets that may cross a cell (docs/theory.md, "Aimed lines"). Eight lanes share a cell. The first take
// the aims that the dismissal by pairs left. If it could not list all carriers, six scouts examine the contacts
// instead: the sheet between the nearest one (direction g0, distance D0) and contact j (g_j, D_j) is crossed at right
// angles by the line through the centre along g_j - g0 (equation 2.11), at about (D_j - D0) / |g_j - g0| from it; each
// proposes its best line, and lines nearly parallel to a better one are given up. The sixth lane, if it is free, and
// the seventh aim at the point equally near to several contacts: curves of the medial surface, such as the axis of a
// round tube, are thinner than any set of lines through centres. The eighth takes the line along g0, whose ends are the
// deep samples of Section 3.2.
#include "lanes/lanes.glsl"
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 7
#include "tree/triangles.glsl"
#include "certified/clip_line.glsl"

layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Aims { Aim aims[]; };
layout(set = 0, binding = 5) writeonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 6) writeonly buffer Work { uint work[]; };  // number of contacts that a line reads

const uint kMostEntries = 4096;   // a lane reads no more of the list than this; proposals need not be the best
const uint kScoutLanes = 6, kSecondTieLane = 5, kTieLane = 6, kDeepLane = 7;
const uint kTieEntries = 64;      // contacts from which the tie is computed
const uint kTieSteps = 3;         // and two more below the finest level
const uint kMostDirectEntries = 8192;  // cells with longer lists get no direct points: lavapipe's loop budget
const uint kDirectDepth = 2;      // levels below the finest voxel from which points are tested directly
const float kParallel = 0.95;     // cosine above which two lines count as the same
const float kAlongNormal = 0.99999;  // cosine
const float kNoLine = 3e38;

shared vec4 proposals[64];  // direction; w: expected distance of the crossing, smaller is better

struct Candidate {
  vec3 direction;
  float key;
};

// The most promising contact among every sixth of the list.
Candidate best_of_run(Cell cell, uint lane, vec3 centre, vec3 g0, float d0, float least_turn) {
  Candidate best = Candidate(vec3(0.0), kNoLine);
  uint stride = kScoutLanes * (1u + cell.list_count / (kScoutLanes * kMostEntries));
  for (uint entry = lane; entry < cell.list_count; entry += stride) {
    vec3 v = vector_to_triangle(centre, load_triangle(lists[cell.list_begin + entry]));
    float d = length(v);
    vec3 across = v / max(d, 1e-30) - g0;
    float turn = length(across);
    float distance_to_sheet = (d - d0) / max(turn, 1e-30);
    float key = distance_to_sheet - 0.2 * step.circumradius * turn;
    bool better = turn >= least_turn && distance_to_sheet <= 1.3 * step.circumradius && key < best.key;
    best.direction = better ? across / turn : best.direction;
    best.key = better ? key : best.key;
  }
  return best;
}

// Loops of turns whose values the lanes of a cell exchange: cells that need none skip them. (Without lockstep, lanes of
// all cells of a workgroup meet in every turn.)
uint turns_of(Cell cell, uint turns) {
#ifdef LOCKSTEP
  return cell.touching != 0u ? turns : 0u;
#else
  return turns;
#endif
}

// The vector from the centre to the point equally far from all contacts that are about as near as the nearest, in the
// sense of least squares: D_j - g_j.x = t for all j, by Gauss-Newton. Where the directions leave a degree of freedom
// (along a sheet or a curve) the step has no component in it. The eight lanes of a cell share its contacts; all of them
// call this.
vec3 step_to_tie(Cell cell, uint lane, vec3 centre, float d0) {
  vec3 x = vec3(0.0);
  float nearest_distance = d0;
  uint stride = kLinesPerCell * (1u + cell.touching / kTieEntries);
  uint turns = turns_of(cell, kTieSteps + 2u * min(step.depth, 1u));
  for (uint k = 0; k < turns; ++k) {
    vec4 directions = vec4(0.0), mixed = vec4(0.0);  // sums of w (g, 1) and w d (g, 1)
    vec4 squares = vec4(0.0), products = vec4(0.0);  // sums of w g g^T: diagonal; xy, xz, yz
    float least = 3e38;
    for (uint entry = lane; entry < cell.touching; entry += stride) {
      vec3 v = vector_to_triangle(centre + x, load_triangle(lists[cell.list_begin + entry]));
      float d = length(v);
      vec3 g = v / max(d, 1e-30);
      float w = clamp(1.0 - 0.5 * (d - nearest_distance) / step.circumradius, 0.0, 1.0);
      least = min(least, d);
      directions += w * vec4(g, 1.0);
      mixed += w * d * vec4(g, 1.0);
      squares.xyz += w * g * g;
      products.xyz += w * g.xxy * g.yzz;
    }
    directions = sum_of_lanes(directions);
    mixed = sum_of_lanes(mixed);
    squares = sum_of_lanes(squares);
    products = sum_of_lanes(products);
    nearest_distance = least_of_lanes(least);
    float weights = max(directions.w, 1e-30);
    mat3 spread = mat3(squares.x, products.x, products.y, products.x, squares.y, products.z, products.y, products.z,
                       squares.z) -
                  outerProduct(directions.xyz, directions.xyz) / weights;
    float trace = spread[0][0] + spread[1][1] + spread[2][2];
    x += inverse(spread + mat3(1e-4 * trace + 1e-12)) * (mixed.xyz - mixed.w / weights * directions.xyz);
    x *= min(1.0, step.circumradius / max(length(x), 1e-30));
  }
  return x;
}

// Of the contacts that tie at a point within epsilon, the direction that differs most from g. For all lanes.
vec3 opposite_direction(Cell cell, uint lane, vec3 point, float nearest_distance, vec3 g) {
  uint stride = kLinesPerCell * (1u + cell.touching / kTieEntries);
  vec3 opposite = g;
  float least = 1.0;
  for (uint entry = lane; entry < cell.touching; entry += stride) {
    vec3 v = vector_to_triangle(point, load_triangle(lists[cell.list_begin + entry]));
    float d = length(v), cosine = dot(v, g) / max(d, 1e-30);
    bool better = d <= nearest_distance + step.epsilon && cosine < least;
    opposite = better ? v / max(d, 1e-30) : opposite;
    least = better ? cosine : least;
  }
  bool is_least = least == least_of_lanes(least);
  vec4 sum = sum_of_lanes(is_least ? vec4(opposite, 1.0) : vec4(0.0));
  return sum.xyz / max(sum.w, 1.0);
}

// The normal of the sheet between the two contacts at the tie whose spokes differ most, or nearly most; 0 at the finest
// level, where no line takes it.
vec3 widest_turn(Cell cell, uint lane, vec3 point) {
  float nearest_distance = 3e38;
  uint stride = kLinesPerCell * (1u + cell.touching / kMostEntries), turns = turns_of(cell, step.depth > 0u ? 3u : 0u);
  uint count = step.depth > 0u ? cell.touching : 0u;
  for (uint entry = lane; entry < count; entry += stride)
    nearest_distance =
        min(nearest_distance, squared_distance_to_triangle(point, load_triangle(lists[cell.list_begin + entry])));
  nearest_distance = sqrt(least_of_lanes(nearest_distance));
  vec3 a = vec3(0.0), b = vec3(0.0);
  for (uint k = 0; k < turns;) {
    b = a;
    a = opposite_direction(cell, lane, point, nearest_distance, b);
    if (++k >= turns) break;
  }
  return unit_or_zero(a - b);
}

// A point that needs no line (docs/theory.md, "Points beside a sheet"): if p, pushed away from its nearest contact a by
// epsilon, is closer than D + epsilon to some contact b, then a medial point lies within epsilon of p, wherever its
// sheet is. If the directions to a and b differ by enough, p represents it.
struct Direct {
  vec3 point;
  vec3 toward;   // b
  float cosine;  // between the directions to a and b; above 1: there is no b
};

// Each lane tests the centre of one eighth of the cell; the widest turn of all lanes is returned to all.
Direct direct_point(Cell cell, uint lane, vec3 centre) {
  vec3 p = centre + 0.25 * step.cell_size * corner_sign(lane), to_a = vec3(0.0), toward = vec3(0.0);
  float least = 3e38, cosine = 2.0;
  uint count = cell.list_count <= kMostDirectEntries ? cell.list_count : 0u;
  for (uint entry = 0; entry < count; ++entry) {
    vec3 v = vector_to_triangle(p, load_triangle(lists[cell.list_begin + entry]));
    to_a = dot(v, v) < least ? v : to_a;
    least = min(least, dot(v, v));
  }
  vec3 a = unit_or_zero(to_a), pushed = p - step.epsilon * a;
  float limit = sqrt(least) + 0.98 * step.epsilon;
  for (uint entry = 0; entry < count; ++entry) {
    TriangleTexels b = load_triangle(lists[cell.list_begin + entry]);
    vec3 g = unit_or_zero(vector_to_triangle(p, b));
    // Only a foot inside a face is certainly the end of a spoke: the angle is that of the sheet between a and b.
    bool is_foot = b.normal.w > 0.5 && dot(g, b.normal.xyz) > kAlongNormal;
    bool better = is_foot && squared_distance_to_triangle(pushed, b) < limit * limit && dot(a, g) < cosine;
    toward = better ? g : toward;
    cosine = better ? dot(a, g) : cosine;
  }
  float widest = least_of_lanes(cosine);
  uint best = first_lane_with(cosine == widest);
  vec4 point = sum_of_lanes(lane == best ? vec4(p, 0.0) : vec4(0.0));
  return Direct(point.xyz, sum_of_lanes(lane == best ? vec4(toward, 0.0) : vec4(0.0)).xyz, widest);
}

void main() {
  uint index = invocation_index();
  uint slot = gl_LocalInvocationID.x, lane = index % kLinesPerCell;
  bool exists = index / kLinesPerCell < counters[kCells];
  bool open = exists && (cells[index / kLinesPerCell].flags & kCellEmpty) == 0u;
  Cell cell;
  cell.touching = 0u;
  cell.list_count = 0u;
  float cos_threshold = -2.0;
  vec3 centre = vec3(0.0), g0 = vec3(0.0), base = vec3(0.0);
  float d0 = 0.0;
  Candidate best = Candidate(vec3(0.0), kNoLine);
  if (open) {
    cell = cells[index / kLinesPerCell];
    centre = cell_centre(uvec3(cell.x, cell.y, cell.z));
    vec3 to_nearest = vector_to_triangle(centre, load_triangle(cell.nearest));
    d0 = length(to_nearest);
    g0 = unit_or_zero(to_nearest);
    bool deep = d0 + step.circumradius + step.slack >= step.radius;
    cos_threshold = cosine_of_least_turn(deep);
    float least_turn = sin(deep ? min(step.deep_angle, step.angle) : step.angle);
    bool aimed = aims[kAimsPerCell * (index / kLinesPerCell)].direction.w > 0.0;
    if (aimed && lane < kAimsPerCell) {
      Aim aim = aims[kAimsPerCell * (index / kLinesPerCell) + lane];
      base = aim.base.xyz;
      best = Candidate(aim.direction.xyz, aim.direction.w > 0.0 ? 0.0 : kNoLine);
    }
    if (!aimed && lane < kScoutLanes) best = best_of_run(cell, lane, centre, g0, d0, least_turn);
    if (lane == kDeepLane) best = Candidate(g0, 1e30);
  }
  Direct direct = Direct(vec3(0.0), vec3(0.0), 2.0);
  if (step.depth >= kDirectDepth) direct = direct_point(cell, lane, centre);
  vec3 tie = step_to_tie(cell, lane, centre, d0), across = widest_turn(cell, lane, centre + tie);
  bool takes_tie = lane == kTieLane || (lane == kSecondTieLane && best.key == kNoLine && step.depth > 0u);
  if (open && takes_tie) {
    base = tie;
    best = Candidate(lane == kSecondTieLane && dot(across, across) > 0.0 ? across : g0, 1e30);
  }
  // Lines that do not pass through the centre are never merged.
  bool alone = dot(base, base) > 0.0 || takes_tie;
  proposals[slot] = alone ? vec4(0.0, 0.0, 0.0, kNoLine) : vec4(best.direction, best.key);
  barrier();
  if (!exists) return;
  bool drop = best.key == kNoLine || dot(best.direction, best.direction) < 0.5;
  for (uint i = slot - lane; i < slot - lane + kLinesPerCell; ++i) {
    bool ahead = proposals[i].w < best.key || (proposals[i].w == best.key && i < slot);
    drop = drop || (ahead && !alone && abs(dot(proposals[i].xyz, best.direction)) > kParallel);
  }
  // A point that needs no line replaces the deep line.
  bool is_direct = open && lane == kDeepLane && direct.cosine <= cos_threshold;
  if (is_direct) {
    atomicAdd(counters[kQueries], 2u);
    points[2 * index] = vec4(direct.point, float(kDirectSeed));
    points[2 * index + 1] = vec4(direct.toward, 1.0);
    work[index] = line_list_count(cell);
    return;
  }
  float from, to;
  drop = drop || !clip_line(cell, centre, base, best.direction, from, to);
  if (!drop) {
    atomicAdd(counters[kQueries], 2u);
    COUNT_TESTS(2u * line_list_count(cell));
  }
  work[index] = drop ? 0u : line_list_count(cell);
  points[2 * index] = vec4(centre + base + from * best.direction, drop ? -1.0 : 1.0);
  points[2 * index + 1] = vec4(centre + base + to * best.direction, 1.0);
}
