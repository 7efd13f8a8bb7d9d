#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// The nearest triangle, among the contacts of a cell, of points in that cell.
// An invocation answers kPointsPerLane points that share a list, so that each triangle is loaded once for all of them.
// Lists longer than kEntriesPerRound take several rounds; each goes on from the result of the one before.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 9
#include "triangles.glsl"

layout(constant_id = 1) const uint kSource = 0;
const uint kLineEnds = 0, kSections = 1, kGrownEnds = 2, kSphere = 3, kOpposites = 4;
layout(constant_id = 2) const uint kPointsPerLane = 8;
layout(constant_id = 3) const uint kPointsPerItem = 8;

layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Points { vec4 points[]; };  // line ends, or samples of a sphere
layout(set = 0, binding = 5) readonly buffer Lines { Line lines[]; };
layout(set = 0, binding = 6) readonly buffer FoundPoints { FoundPoint found[]; };
layout(set = 0, binding = 7) buffer Nearest { uvec2 nearest[]; };  // squared distance (bits), triangle
layout(set = 0, binding = 8) readonly buffer Asked { uint asked[]; };  // groups of opposites of flux samples

uint cell_of(uint item) {
  if (kSource == kLineEnds) return item / step.lines_per_cell;
  if (kSource == kSphere) return found[step.first_item + item].cell;
  if (kSource == kOpposites) return found[step.first_item + item / (kFluxSamples / kFluxGroup)].cell;
  return lines[item].cell;
}

vec3 point_of(uint item, uint index) {
  if (kSource == kLineEnds || kSource == kSphere || kSource == kOpposites) return points[kPointsPerItem * item + index].xyz;
  if (kSource == kSections) {
    float share = float(index + 1) / float(kSectionsPerLine + 1);
    return mix(lines[item].p.xyz, lines[item].q.xyz, share);
  }
  // The end of the line, pushed away from its contact by epsilon (growth test, Lemma 2.3).
  return index == 0 ? lines[item].p.xyz - step.epsilon * lines[item].toward_p.xyz
                    : lines[item].q.xyz - step.epsilon * lines[item].toward_q.xyz;
}

void main() {
  uint lanes_per_item = kPointsPerItem / kPointsPerLane;
  uint index = invocation_index();
  uint item = index / lanes_per_item;
  uint before = kSource == kOpposites ? 0u : step.first_item;
  if (before + item >= counters[step.items_counter] * step.items_multiplier) return;
  if (kSource == kOpposites) item = asked[item];
  uint first_point = (index % lanes_per_item) * kPointsPerLane;
  Cell cell = cells[cell_of(item)];
  uint entry = step.first_entry;
  bool is_line = kSource == kLineEnds || kSource == kSections || kSource == kGrownEnds;
  uint list_count = is_line ? line_list_count(cell) : cell.list_count;
  if (entry >= list_count) return;
  if (kSource == kLineEnds && points[2 * item].w < 0.0) return;  // no line

  vec3 point[kPointsPerLane];
  float best[kPointsPerLane];
  uint triangle[kPointsPerLane];
  uint result = item * kPointsPerItem + first_point;
  [[unroll]] for (uint k = 0; k < kPointsPerLane; ++k) {
    point[k] = point_of(item, first_point + k);
    uvec2 so_far = entry == 0 ? uvec2(0x7f800000u, 0u) : nearest[result + k];
    best[k] = uintBitsToFloat(so_far.x);
    triangle[k] = so_far.y;
  }
  uint end = min(list_count, entry + kEntriesPerRound);
  for (;;) {
    uint t = lists[cell.list_begin + entry];
    TriangleTexels texels = load_triangle(t);
    [[unroll]] for (uint k = 0; k < kPointsPerLane; ++k) {
      float d = squared_distance_to_triangle(point[k], texels);
      bool nearer = d < best[k];
      best[k] = nearer ? d : best[k];
      triangle[k] = nearer ? t : triangle[k];
    }
    if (++entry >= end) break;
  }
  [[unroll]] for (uint k = 0; k < kPointsPerLane; ++k) nearest[result + k] = uvec2(floatBitsToUint(best[k]), triangle[k]);
}
