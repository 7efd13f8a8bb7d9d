// Decides whether a narrowed line ends at a salient medial point. The directions at its ends must differ by twice the
// object angle (or the radius must suffice), and the ball at the accepted end, grown by epsilon away from its contact,
// must meet the boundary elsewhere (Lemma 2.3). If the side of the end is unknown, it is queried before the voxel
// elects its point. Include after declaring `counters`, `lines`, `requests` and `winners`.
#ifndef MEDIAL_VK_VERIFY_LINE_GLSL
#define MEDIAL_VK_VERIFY_LINE_GLSL
#include "certified/in_voxel.glsl"
#include "lanes/elect.glsl"

// A hundredth of epsilon excludes most of float's rounding; certify_spheres() repeats the test in double and decides.
const float kGrowthMargin = 0.01;
// Closer to the boundary than this many rounding errors, directions are dominated by rounding.
const float kLeastRadius = 8.0;

bool is_medial(float distance_before, float distance_after, float turn) {
  bool deep = distance_before >= step.radius;
  return distance_before >= kLeastRadius * step.slack && turn <= cosine_of_least_turn(deep) &&
         distance_after < distance_before + (1.0 - kGrowthMargin) * step.epsilon;
}

// `grown`: distances of its two ends from the boundary, after each has been pushed away from its contact.
void verify_line(uint index, Cell cell, vec2 grown) {
  float turn = dot(lines[index].toward_p.xyz, lines[index].toward_q.xyz);
  float gap = distance(lines[index].p.xyz, lines[index].q.xyz);
  // If the distances at the ends add up to more than the gap, the boundary does not pass between them. Otherwise the
  // directions may differ only because one end lies outside, next to a crease of any angle.
  bool narrow = gap <= step.epsilon && lines[index].p.w + lines[index].q.w > 1.01 * gap;
  bool p = narrow && is_in_voxel(lines[index].p.xyz, cell) && is_medial(lines[index].p.w, grown.x, turn);
  bool q = narrow && is_in_voxel(lines[index].q.xyz, cell) && is_medial(lines[index].q.w, grown.y, turn);
  lines[index].accepted = p ? 1u : q ? 2u : 0u;
  if (!p && !q) return;
  // If open edges are not listed, sides of cells rest on an assumption: the side of each point is queried.
  bool inside = step.open_edges <= kMostOpenEdges && (cell.flags & kCellInside) != 0u;
  if (inside)
    elect(index, lines[index].voxel, turn);
  else
    requests[atomicAdd(counters[kRequests], 1u)] = index;
}

#endif
