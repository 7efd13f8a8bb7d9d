// Definitions that the kernels of the certified pipeline share: push constants, invocation index, geometry of cells.
#ifndef MEDIAL_VK_STEP_GLSL
#define MEDIAL_VK_STEP_GLSL
#include "gpu_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push { StepConstants step; };

uint invocation_index() { return workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

// Statistics of this level, for kernels that declare `counters`.
#define COUNT(which, number) atomicAdd(counters[kStatistics + kStatisticsPerLevel * step.level + (which)], number)
// The same in two words.
#define COUNT_LONG(which, number)                                                \
  {                                                                              \
    uint counted_now = number, counted_before = COUNT(which, counted_now);       \
    if (counted_before + counted_now < counted_before) COUNT((which) + 1u, 1u);  \
  }
#define COUNT_TESTS(number) COUNT_LONG(kTestCount, number)

// The required turn between the directions at the ends of a line that is worth narrowing: twice the object angle, or,
// if one of the ends is deep, the requirement for deep points, if that is less.
float cosine_of_least_turn(bool deep) {
  return deep ? max(step.cos_twice_angle, step.cos_twice_deep_angle) : step.cos_twice_angle;
}

// Lines of a finest voxel stay in the region for which the contacts that touch it suffice (touch_half_side).
uint line_list_count(Cell cell) { return step.depth == 0u ? cell.touching : cell.list_count; }

// Masks of a cell's list, one for each of its seeds of lines, stored in the later masks of its children.
uint line_mask_begin(Cell cell, uint seed) {
  return 8u * cell.word_begin + seed * ((line_list_count(cell) + 31u) / 32u);
}

// Children are numbered 0 to 7: bit 0 is x, bit 1 is y, bit 2 is z.
uvec3 child_coordinates(Cell parent, uint child) {
  return 2 * uvec3(parent.x, parent.y, parent.z) + uvec3(child & 1u, (child >> 1) & 1u, child >> 2);
}

// Top cells are counted along x, then y, then z.
uvec3 top_cell_coordinates(uint index) {
  uvec3 voxels = uvec3(step.grid_x, step.grid_y, step.grid_z);
  uvec3 grid = (voxels + step.voxels_per_cell - 1u) / step.voxels_per_cell;
  return uvec3(index % grid.x, index / grid.x % grid.y, index / (grid.x * grid.y));
}

vec3 cell_centre(uvec3 coordinates) { return (vec3(coordinates) + 0.5) * step.cell_size; }

// Lower corner of the finest voxel that a cell at or below the finest level is or lies in.
vec3 finest_voxel_corner(Cell cell) {
  return vec3(uvec3(cell.x, cell.y, cell.z) >> step.depth) * step.voxel_size;
}

// Corners are numbered like children.
vec3 corner_sign(uint k) { return vec3(k & 1u, (k >> 1) & 1u, k >> 2) * 2.0 - 1.0; }

// The extents h of corners 7, 5, 3 and 1 of a cube along a direction, in units of half the side. Corners 0, 2, 4 and 6
// are opposite.
vec4 corners_along(vec3 h) {
  vec2 xy = vec2(h.x + h.y, h.x - h.y);
  return vec4(xy + h.z, xy - h.z);
}

// Not for NaN, which the built-in function handles; on lavapipe that takes three instructions instead of one.
float greater(float a, float b) {
  precise float result = a > b ? a : b;
  return result;
}

// The greatest sum, over the eight corners, of a value of the corner and its extent along a direction.
float most_at_corners(float corners[8], vec4 along) {
  vec4 forth = vec4(corners[7], corners[5], corners[3], corners[1]) + along;
  vec4 back = vec4(corners[0], corners[2], corners[4], corners[6]) - along;
  vec4 most = vec4(greater(forth.x, back.x), greater(forth.y, back.y), greater(forth.z, back.z), greater(forth.w, back.w));
  return greater(greater(most.x, most.y), greater(most.z, most.w));
}

// Rounding of Lemma A (docs/theory.md): two distances, and g.x with |x| up to the circumradius, where g has an error of
// up to 2 slack / D.
float distance_slack(float d, float circumradius) { return 4.0 * step.slack * (1.0 + circumradius / max(d, 1e-30)); }

// If the boundary itself passes through triangles whose normals prove nothing, a cell may hold medial points of either
// side, and subdivision follows them to the boundary: five levels below the finest voxel are enough. Medial points in
// the remaining cells have a radius below sqrt(3) / 32 of the voxel side.
bool is_hopeless(uint flags) { return step.depth >= kBoundaryDepth && (flags & kCellUntrusted) != 0u; }

// The bits of a non-negative number, which have the same order. Devices may give a zero either sign.
uint ordered_bits(float x) { return floatBitsToUint(x) & 0x7fffffffu; }

vec3 unit_or_zero(vec3 v) {
  float squared = dot(v, v);
  return squared > 0.0 ? v * inversesqrt(squared) : vec3(0.0);
}

#endif
