#version 450
#extension GL_GOOGLE_include_directive : enable
// Is the end p salient (Algorithm 2)? Then asks whether the ball at p, pushed away from its contact by epsilon and grown
// by as much, meets the boundary elsewhere (Lemma 2.3; it may not where the segment ran through the boundary), and, if
// the voxel's sphere meets the boundary, on which side p lies.
#include "thesis.glsl"
layout(set = 0, binding = 1) readonly buffer Voxels { ThesisCell voxels[]; };
layout(set = 0, binding = 2) buffer Lines { Retraction lines[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { vec4 nearest[]; };  // of q
layout(set = 0, binding = 4) writeonly buffer Balls { vec4 balls[]; };
layout(set = 0, binding = 5) writeonly buffer Sides { vec4 sides[]; };

void main() {
  uint item = invocation_index();
  if (item >= item_count()) return;
  balls[item] = vec4(0.0, 0.0, 0.0, kPassOver);
  sides[item] = vec4(0.0, 0.0, 0.0, kPassOver);
  if (lines[item].p.w == 0.0) return;
  vec3 p = lines[item].p.xyz, q = lines[item].q.xyz, to_contact = lines[item].contact.xyz - p;
  vec3 toward_p = unit_or_zero(to_contact), toward_q = unit_or_zero(nearest[item].xyz - q);
  float radius = length(to_contact);
  float angle = atan(distance(toward_p, toward_q), length(toward_p + toward_q));
  bool salient = radius > step.epsilon && (angle > step.angle || radius > step.radius);
  lines[item].p.w = salient ? 1.0 : 0.0;
  if (!salient) return;
  lines[item].q = vec4(toward_q, angle);
  float grown = radius + step.epsilon - step.ball_margin;
  balls[item] = vec4(p - step.epsilon * toward_p, grown * grown);
  ThesisCell voxel = voxels[lines[item].voxel];
  bool sphere_inside = (voxel.flags & kThesisInside) != 0u && voxel.distance >= step.cell_size;
  sides[item] = vec4(p, sphere_inside && step.closed != 0u ? kPassOver : kAnyDistance);
  atomicAdd(counters[kThesisQueries], 1u);
}
