#version 450
#extension GL_GOOGLE_include_directive : enable
// The first line of a finest voxel, the only one that most voxels need: across the sheet between its nearest contact
// and the partner that mark_contacts.comp has found.
#include "certified/step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 5
#include "tree/triangles.glsl"
#include "certified/aim.glsl"
#include "certified/clip_line.glsl"

layout(set = 0, binding = 1) readonly buffer Cells { Cell cells[]; };
layout(set = 0, binding = 2) buffer Counters { uint counters[]; };
layout(set = 0, binding = 3) writeonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 4) writeonly buffer Work { uint work[]; };  // number of contacts that the line reads

vec4 contact_of(vec3 centre, uint triangle) {
  vec3 v = vector_to_triangle(centre, load_triangle(triangle));
  return vec4(unit_or_zero(v), length(v));
}

void main() {
  uint index = invocation_index();
  if (index >= counters[kCells]) return;
  Cell cell = cells[index];
  points[2 * index] = vec4(0.0, 0.0, 0.0, -1.0);
  work[index] = 0u;
  if (cell.partner == kNoTriangle) return;
  vec3 centre = cell_centre(uvec3(cell.x, cell.y, cell.z));
  Aim aim = aim_between(contact_of(centre, cell.nearest), contact_of(centre, cell.partner), step.half_side);
  float from, to;
  if (aim.direction.w == 0.0 || !clip_line(cell, centre, aim.base.xyz, aim.direction.xyz, from, to)) return;
  atomicAdd(counters[kQueries], 2u);
  COUNT_TESTS(2u * line_list_count(cell));
  work[index] = line_list_count(cell);
  points[2 * index] = vec4(centre + aim.base.xyz + from * aim.direction.xyz, 1.0);
  points[2 * index + 1] = vec4(centre + aim.base.xyz + to * aim.direction.xyz, 1.0);
}
