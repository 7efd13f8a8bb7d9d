#version 450
#extension GL_GOOGLE_include_directive : enable
// Aims at the sheets that may cross a cell (docs/theory.md, "Aimed lines"). The sheet between the nearest contact
// (direction g0, distance D0) and contact j (g_j, D_j) is crossed at right angles by the line through the centre
// along g_j - g0 (equation 2.11), at about (D_j - D0) / |g_j - g0| from it. Eight lanes share a cell: seven look
// through the list, each proposes its best line, and lines nearly parallel to a better one are given up; the eighth
// takes the line along g0, whose ends are the deep samples of Section 3.2.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 5
#include "triangles.glsl"

layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) writeonly buffer Points { vec4 points[]; };

const uint kMostEntries = 4096;   // a lane looks at no more of the list than this; proposals need not be the best
const float kParallel = 0.95;     // cosine above which two lines count as the same
const float kNoLine = 3e38;

shared vec4 proposals[64];  // direction; w: how far the crossing is expected, smaller is better

struct Candidate {
  vec3 direction;
  float key;
};

// The most promising contact among every seventh of the list.
Candidate best_of_run(Cell cell, uint lane, vec3 centre, vec3 g0, float d0, float least_turn) {
  Candidate best = Candidate(vec3(0.0), kNoLine);
  uint stride = (kLinesPerCell - 1u) * (1u + cell.list_count / ((kLinesPerCell - 1u) * kMostEntries));
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

// The part of the line through the centre that lies in the cell's ball and in the finest voxel, both enlarged by
// epsilon: a point within epsilon of the medial surface may stand for a sheet that runs along a face of its voxel, just
// outside. Only ends inside the voxel are accepted (verify_lines.comp).
bool clip_line(Cell cell, vec3 centre, vec3 direction, out float from, out float to) {
  vec3 lower = finest_voxel_corner(cell) - step.epsilon, upper = lower + step.voxel_size + 2.0 * step.epsilon;
  vec3 a = (lower - centre) / direction, b = (upper - centre) / direction;
  vec3 low = min(a, b), high = max(a, b);
  from = -step.circumradius - step.epsilon;
  to = step.circumradius + step.epsilon;
  for (uint k = 0; k < 3u; ++k) {
    if (abs(direction[k]) < 1e-6) continue;  // the centre is inside
    from = max(from, low[k]);
    to = min(to, high[k]);
  }
  return to > from;
}

void main() {
  uint index = invocation_index();
  uint slot = gl_LocalInvocationID.x, lane = index % kLinesPerCell;
  bool exists = index / kLinesPerCell < counters[kCells];
  Cell cell;
  vec3 centre, g0;
  Candidate best = Candidate(vec3(0.0), kNoLine);
  if (exists) {
    cell = cells[index / kLinesPerCell];
    centre = cell_centre(uvec3(cell.x, cell.y, cell.z));
    vec3 to_nearest = vector_to_triangle(centre, load_triangle(cell.nearest));
    float d0 = length(to_nearest);
    g0 = unit_or_zero(to_nearest);
    bool deep = d0 + step.circumradius + step.slack >= step.radius;
    float least_turn = sin(deep ? min(step.deep_angle, step.angle) : step.angle);
    if (lane < kLinesPerCell - 1u) best = best_of_run(cell, lane, centre, g0, d0, least_turn);
    if (lane == kLinesPerCell - 1u) best = Candidate(g0, 1e30);
  }
  proposals[slot] = vec4(best.direction, best.key);
  barrier();
  if (!exists) return;
  bool drop = best.key == kNoLine || dot(best.direction, best.direction) < 0.5;
  for (uint i = slot - lane; i < slot - lane + kLinesPerCell; ++i) {
    bool ahead = proposals[i].w < best.key || (proposals[i].w == best.key && i < slot);
    drop = drop || (ahead && abs(dot(proposals[i].xyz, best.direction)) > kParallel);
  }
  float from, to;
  drop = drop || !clip_line(cell, centre, best.direction, from, to);
  points[2 * index] = vec4(centre + from * best.direction, drop ? -1.0 : 1.0);
  points[2 * index + 1] = vec4(centre + to * best.direction, 1.0);
}
