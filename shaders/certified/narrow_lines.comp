#version 450
#extension GL_GOOGLE_include_directive : enable
// One narrowing step: selects, of the nine parts into which the eight inner points divide a line, the one over which
// the direction to the boundary turns most. (Bisection towards the first change of the nearest point, Algorithm 1,
// would end at a crease between neighbouring facets.) Directions also flip where the line crosses the boundary itself,
// and there the distances at the ends of the part add up to no more than its length: such a part is selected only if no
// other turns enough, and before those that do not.
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 5
#include "certified/in_voxel.glsl"
#include "tree/triangles.glsl"

layout(set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) buffer Lines { Line lines[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 4) readonly buffer Cells { Cell cells[]; };

const uint kParts = kSectionsPerLine + 1u;

struct End {
  vec4 point;   // w: distance to the boundary
  vec4 toward;  // unit vector to its nearest point
};

// Between parts k and k + 1 of a line; 0 and kParts are its own ends.
End end_at(Line line, uint index, uint k) {
  vec3 point = mix(line.p.xyz, line.q.xyz, float(k) / float(kParts));
  uint section = clamp(k, 1u, kSectionsPerLine) - 1u;
  vec3 v = vector_to_triangle(point, load_triangle(nearest[kSectionsPerLine * index + section].y));
  vec4 inner = vec4(point, length(v)), toward = vec4(unit_or_zero(v), 0.0);
  return End(k == 0u ? line.p : k == kParts ? line.q : inner,
             k == 0u ? line.toward_p : k == kParts ? line.toward_q : toward);
}

float turn_between(End a, End b) { return dot(a.toward.xyz, b.toward.xyz); }

// The turn that verify_line.glsl requires: less if one of the ends is deep.
bool turns_enough(End a, End b) {
  bool deep = max(a.point.w, b.point.w) + step.slack >= step.radius;
  return turn_between(a, b) <= cosine_of_least_turn(deep);
}

bool may_cross_boundary(End a, End b) {
  return a.point.w + b.point.w <= 1.001 * distance(a.point.xyz, b.point.xyz) + step.slack;
}

// The least rank is best: first parts that turn enough, then those of them that may cross the boundary, then of the
// others the one that turns most.
float rank(End a, End b) {
  float turn = turn_between(a, b);
  return !turns_enough(a, b) ? turn + 4.0 : may_cross_boundary(a, b) ? turn + 2.0 : turn;
}

// So close to each other that the growth test should hold at both (verify_line.glsl decides): docs/theory.md, "How far
// to narrow", with the actual angle.
bool is_narrow(End a, End b) {
  float d = min(a.point.w, b.point.w);
  float longest = 0.4 * (1.0 - turn_between(a, b)) * step.epsilon * d / (d + step.epsilon);
  return turns_enough(a, b) && distance(a.point.xyz, b.point.xyz) <= longest;
}

// The best part, and its ends: it lies between ends k - 1 and k.
uint best_part(Line line, uint index, out End p, out End q) {
  float least = 8.0;  // more than any rank
  uint best = 0u, k = 1u;
  End last = End(line.p, line.toward_p);
  p = last;
  q = last;
  while (k <= kParts) {
    End next = end_at(line, index, k);
    float now = rank(last, next);
    bool is_better = now < least;
    least = min(least, now);
    best = is_better ? k : best;
    p = is_better ? last : p;
    q = is_better ? next : q;
    last = next;
    if (++k > kParts) break;
  }
  return best;
}

// A sheet that runs along a face of its voxel, as those of symmetric solids often do, leaves the ends of the best part
// on the face, or in the next voxel. One of them then moves away from the sheet, into the voxel.
void move_into_voxel(Line line, uint index, Cell cell, uint best, inout End p, inout End q) {
  for (uint away = 1u; away < kParts; ++away) {
    if (away < best) {
      End end = end_at(line, index, best - 1u - away);
      if (is_in_voxel(end.point.xyz, cell) && is_narrow(end, q)) {
        p = end;
        return;
      }
    }
    if (best + away <= kParts) {
      End end = end_at(line, index, best + away);
      if (is_in_voxel(end.point.xyz, cell) && is_narrow(p, end)) {
        q = end;
        return;
      }
    }
  }
}

void main() {
  uint index = invocation_index();
  if (index >= counters[kLines]) return;
  Line line = lines[index];
  Cell cell = cells[line.cell];
  End p, q;
  uint best = best_part(line, index, p, q);
  bool is_outside = !is_in_voxel(p.point.xyz, cell) && !is_in_voxel(q.point.xyz, cell);
  // Longer parts are never narrow.
  if (is_outside && distance(p.point.xyz, q.point.xyz) < step.epsilon) move_into_voxel(line, index, cell, best, p, q);
  lines[index].p = p.point;
  lines[index].q = q.point;
  lines[index].toward_p = p.toward;
  lines[index].toward_q = q.toward;
}
