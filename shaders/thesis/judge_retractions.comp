#version 450
#extension GL_GOOGLE_include_directive : enable
// Decides whether the end p is salient (Algorithm 2). If so, queries whether the ball at p, pushed away from its
// contact by epsilon and grown by as much, meets the boundary elsewhere (Lemma 2.3; it may not if the segment passed
// through the boundary), and, if the voxel's sphere meets the boundary, the side of p.
//
// Balls are reduced by ball_margin, so p may lie beyond the point at which B changes, by up to ball_margin over 1 -
// cos(turn), the rate at which the two distances part. p is moved back by this amount; if it is not a small part of
// epsilon, the turn is too small to be distinguished from rounding.
#include "thesis/thesis.glsl"
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
  vec3 contact = lines[item].contact.xyz, q = lines[item].q.xyz;
  vec3 toward_p = unit_or_zero(contact - lines[item].p.xyz), toward_q = unit_or_zero(nearest[item].xyz - q);
  float back = step.ball_margin / max(1.0 - dot(toward_p, toward_q), 1e-12);
  vec3 p = lines[item].p.xyz + back * toward_p;
  float radius = distance(p, contact);
  float angle = atan(distance(toward_p, toward_q), length(toward_p + toward_q));
  ThesisCell voxel = voxels[lines[item].voxel];
  bool in_voxel = all(lessThan(abs(p - cell_centre(voxel)), vec3(0.5 * step.cell_size - step.slack)));
  bool salient = angle > step.angle || radius > step.radius;
  salient = salient && in_voxel && back < 0.5 * step.epsilon && radius > step.slack;
  lines[item].p = vec4(p, salient ? 1.0 : 0.0);
  if (!salient) return;
  lines[item].q = vec4(toward_q, angle);
  float grown = radius + step.epsilon - step.ball_margin;
  balls[item] = vec4(p - step.epsilon * toward_p, grown * grown);
  bool sphere_inside = (voxel.flags & kThesisInside) != 0u && voxel.distance >= step.cell_size;
  sides[item] = vec4(p, sphere_inside && step.closed != 0u ? kPassOver : kAnyDistance);
  atomicAdd(counters[kThesisQueries], 1u);
}
