#version 450
#extension GL_GOOGLE_include_directive : enable
// The nearest triangles, among the contacts of a cell, of the two ends of every proposed line, and a mask of the
// contacts that may be the nearest of some point of the line, which are all that narrowing and the growth test read. A
// line is worth narrowing if the direction to the boundary turns by at least twice the object angle between its ends;
// points that need no line have passed that test already. Lists longer than kEntriesPerRound take several rounds; each
// continues from the result of the previous one.
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 9
#include "tree/triangles.glsl"
#include "certified/segment_test.glsl"

layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 5) buffer Nearest { uvec2 nearest[]; };       // squared distance (bits), triangle
layout(set = 0, binding = 6) writeonly buffer Masks { uint masks[]; };  // of every seed of the cell
layout(set = 0, binding = 7) buffer States { uvec4 states[]; };  // x: worth narrowing; w: contacts in its mask
layout(set = 0, binding = 8) readonly buffer Order { uint order[]; };  // sort_by_work.comp

float distance_to(vec3 p, uint triangle) { return length(vector_to_triangle(p, load_triangle(triangle))); }

Segment segment_of(Cell cell, vec3 p, vec3 q) {
  uint second = cell.partner == kNoTriangle ? cell.nearest : cell.partner;
  return segment_between(p, q, vec2(distance_to(p, cell.nearest), distance_to(q, cell.nearest)),
                         vec2(distance_to(p, second), distance_to(q, second)));
}

bool is_worth_narrowing(vec3 p, vec3 q, uint triangle_p, uint triangle_q) {
  vec3 a = vector_to_triangle(p, load_triangle(triangle_p)), b = vector_to_triangle(q, load_triangle(triangle_q));
  float turn = dot(unit_or_zero(a), unit_or_zero(b));
  bool deep = max(length(a), length(b)) + step.slack >= step.radius;
  return turn <= cosine_of_least_turn(deep);
}

void main() {
  uint item = invocation_index();
  if (item >= step.lines_per_cell * counters[kCells]) return;
  if (step.depth <= kSortedDepth) item = order[item];
  if (step.first_entry == 0u) states[item] = uvec4(0u);
  Cell cell = cells[item / step.lines_per_cell];
  uint list_count = line_list_count(cell), entry = step.first_entry;
  if (entry >= list_count || points[2 * item].w < 0.0) return;  // no line

  vec3 p = points[2 * item].xyz;
  bool is_direct = points[2 * item].w == float(kDirectSeed);
  vec3 q = is_direct ? p : points[2 * item + 1].xyz;
  Segment segment = segment_of(cell, p, q);
  uvec2 best_p = entry == 0u ? uvec2(kFarthestBits, 0u) : nearest[2 * item];
  uvec2 best_q = entry == 0u ? best_p : nearest[2 * item + 1];
  uint end = min(list_count, entry + kEntriesPerRound);
  uint base = line_mask_begin(cell, item % step.lines_per_cell), word = 0u, listed_count = 0u;
  while (entry < end) {
    uint t = lists[cell.list_begin + entry];
    TriangleTexels texels = load_triangle(t);
    vec3 v_p = vector_to_triangle(p, texels), v_q = vector_to_triangle(q, texels);
    float square_p = dot(v_p, v_p), square_q = dot(v_q, v_q);
    best_p = square_p < uintBitsToFloat(best_p.x) ? uvec2(floatBitsToUint(square_p), t) : best_p;
    best_q = square_q < uintBitsToFloat(best_q.x) ? uvec2(floatBitsToUint(square_q), t) : best_q;
    bool listed = may_be_nearest_on(segment, v_p, sqrt(square_p), v_q, sqrt(square_q));
    word |= listed ? 1u << (entry & 31u) : 0u;
    ++entry;
    if ((entry & 31u) == 0u || entry >= end) {
      masks[base + (entry - 1u) / 32u] = word;
      listed_count += bitCount(word);
      word = 0u;
    }
    if (entry >= end) break;
  }
  nearest[2 * item] = best_p;
  nearest[2 * item + 1] = best_q;
  states[item].w += listed_count;
  if (end < list_count) return;
  bool is_worth = is_direct || is_worth_narrowing(p, q, best_p.y, best_q.y);
  states[item].x = is_worth ? 1u : 0u;
}
