// Aims at the sheet between two contacts of a cell.
#ifndef MEDIAL_VK_AIM_GLSL
#define MEDIAL_VK_AIM_GLSL

const float kNoAim = 3e38;

// The crossing of the cell by the plane between two contacts, given by their directions and distances (w) (equation
// 2.11): the point nearest to the centre, or, if that point is outside, the point towards the corner in its direction.
// The w of the direction is 0 if the plane does not cross the cell.
Aim aim_between(vec4 a, vec4 b, float half_side) {
  vec3 across = b.xyz - a.xyz;
  float turn = length(across), offset = b.w - a.w;
  float extent = half_side * dot(abs(across), vec3(1.0));
  bool crosses = turn >= 0.1 && abs(offset) <= 1.2 * extent;
  vec3 base = across * (offset / max(turn * turn, 1e-2));
  if (any(greaterThan(abs(base), vec3(half_side))))
    base = clamp(offset / max(extent, 1e-30), -1.0, 1.0) * half_side *
           mix(vec3(-1.0), vec3(1.0), greaterThan(across, vec3(0.0)));
  float away = max(0.0, max(a.w - dot(a.xyz, base), b.w - dot(b.xyz, base)));
  return Aim(vec4(base, crosses ? away : kNoAim), crosses ? vec4(across / turn, 1.0) : vec4(0.0));
}

#endif
