#version 450
#extension GL_GOOGLE_include_directive : enable
#extension GL_EXT_control_flow_attributes : enable
// The nearest triangle, among the contacts of a cell, of points in that cell.
// An invocation handles kPointsPerLane points that share a list, so that each triangle is loaded once for all of them:
// those of a line, or of a group of flux samples or of their opposites.
// Points of a line read only the contacts that find_line_ends.comp has left for it, and samples those that
// mark_samples.comp has left for their group. The grown ends of a line decide whether it has found a point. Lists
// longer than kEntriesPerRound take several rounds; each continues from the result of the previous one.
#include "certified/step.glsl"
#include "certified/flux_samples.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 12
#include "tree/triangles.glsl"

layout(constant_id = 1) const uint kSource = 0;
const uint kSections = 0, kGrownEnds = 1, kSamples = 2, kOpposites = 3;
layout(constant_id = 2) const uint kPointsPerLane = 8;

layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) readonly buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) buffer Counters { uint counters[]; };
layout(set = 0, binding = 4) readonly buffer Points { vec4 points[]; };  // opposites of flux samples
layout(set = 0, binding = 5) buffer Lines { Line lines[]; };
layout(set = 0, binding = 6) readonly buffer FoundPoints { FoundPoint found[]; };
layout(set = 0, binding = 7) buffer Nearest { uvec2 nearest[]; };  // squared distance (bits), triangle
layout(set = 0, binding = 8) buffer Requests { uint requests[]; };  // groups of opposites; lines without a known side
layout(set = 0, binding = 9) readonly buffer Masks { uint masks[]; };  // of the lists, for every line or group
layout(set = 0, binding = 10) buffer Winners { uint winners[]; };
layout(set = 0, binding = 11) readonly buffer Order { uint order[]; };  // of lines and samples: sort_by_work.comp
#include "certified/verify_line.glsl"

const bool kIsLine = kSource == kSections || kSource == kGrownEnds;

// Index in a group, in the block of spheres that starts at the first item.
uint sphere_of(uint item) { return (step.first_item + item) / kGroupsPerSphere; }

uint cell_of(uint item) { return kIsLine ? lines[item].cell : found[sphere_of(item)].cell; }

vec3 point_of(uint item, uint index) {
  if (kSource == kOpposites) return points[kPointsPerLane * item + index].xyz;
  if (kSource == kSamples)
    return sample_point(voxel_centre(found[sphere_of(item)]), sample_of_group(item % kGroupsPerSphere, index));
  if (kSource == kSections) {
    float share = float(index + 1) / float(kSectionsPerLine + 1);
    return mix(lines[item].p.xyz, lines[item].q.xyz, share);
  }
  // The end of the line, pushed away from its contact by epsilon (growth test, Lemma 2.3).
  return index == 0 ? lines[item].p.xyz - step.epsilon * lines[item].toward_p.xyz
                    : lines[item].q.xyz - step.epsilon * lines[item].toward_q.xyz;
}

// The slot for the result of a point.
uint result_of(uint item, uint index) {
  uint sample_index = kSource == kSamples ? sample_of_group(item % kGroupsPerSphere, index) : 0u;
  return kSource == kSamples ? item / kGroupsPerSphere * kFluxSamples + sample_index : item * kPointsPerLane + index;
}

vec3 point[kPointsPerLane];
float best[kPointsPerLane];
uint triangle[kPointsPerLane];

void test(uint t, bool counts) {
  TriangleTexels texels = load_triangle(t);
  [[unroll]] for (uint k = 0; k < kPointsPerLane; ++k) {
    float d = squared_distance_to_triangle(point[k], texels);
    bool nearer = counts && d < best[k];
    best[k] = nearer ? d : best[k];
    triangle[k] = nearer ? t : triangle[k];
  }
}

// Examines the entries whose bits are set, with an iteration for each, and one for each word. Returns their number.
uint test_masked(Cell cell, uint base, uint begin, uint end) {
  uint w = begin / 32u, last_word = (end - 1u) / 32u, word = masks[base + w], count = 0u;
  while (w <= last_word) {
    bool counts = word != 0u;
    uint bit = counts ? uint(findLSB(word)) : 0u;
    test(lists[cell.list_begin + 32u * w + bit], counts);
    count += counts ? 1u : 0u;
    word &= word - 1u;
    bool next = word == 0u;
    w += next ? 1u : 0u;
    word = next && w <= last_word ? masks[base + w] : word;
    if (w > last_word) break;
  }
  return count;
}

void test_all(Cell cell, uint entry, uint end) {
  while (entry < end) {
    test(lists[cell.list_begin + entry], true);
    if (++entry >= end) break;
  }
}

void main() {
  uint item = invocation_index();
  // Groups of opposites are packed, from the whole block of spheres that the caller gives.
  const bool is_packed = kSource == kOpposites;
  if ((is_packed ? item : step.first_item + item) >= counters[step.items_counter] * step.items_multiplier) return;
  if (is_packed) item = requests[item];
  if (kIsLine && step.depth <= kSortedDepth || kSource == kSamples) item = order[item];
  Cell cell = cells[cell_of(item)];
  uint entry = step.first_entry;
  uint list_count = kIsLine ? line_list_count(cell) : cell.list_count;
  if (entry >= list_count) return;

  [[unroll]] for (uint k = 0; k < kPointsPerLane; ++k) {
    point[k] = point_of(item, k);
    uvec2 so_far = entry == 0 ? uvec2(kFarthestBits, 0u) : nearest[result_of(item, k)];
    best[k] = uintBitsToFloat(so_far.x);
    triangle[k] = so_far.y;
  }
  uint end = min(list_count, entry + kEntriesPerRound);
  if (kIsLine) {
    uint test_count = test_masked(cell, line_mask_begin(cell, lines[item].seed), entry, end);
    COUNT_TESTS(kPointsPerLane * test_count);
  } else if (kSource == kSamples) {
    test_masked(cell, sample_mask_begin(cell, item % kGroupsPerSphere), entry, end);
  } else {
    test_all(cell, entry, end);
    COUNT_TESTS(kPointsPerLane * (end - entry));
  }
  [[unroll]] for (uint k = 0; k < kPointsPerLane; ++k)
    nearest[result_of(item, k)] = uvec2(floatBitsToUint(best[k]), triangle[k]);
  if (kSource == kGrownEnds && end >= list_count) verify_line(item, cell, sqrt(vec2(best[0], best[1])));
}
