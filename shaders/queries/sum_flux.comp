#version 450
#extension GL_GOOGLE_include_directive : enable
// Average outward flux of the gradient of D through every sphere (equation 2.4), without two-sided fans.
#include "tree/sphere_samples.glsl"
layout(set = 0, binding = 2) readonly buffer Samples { vec4 samples[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { vec4 nearest[]; };
layout(set = 0, binding = 4) readonly buffer Opposites { vec4 opposites[]; };
layout(set = 0, binding = 5) readonly buffer OppositeNearest { vec4 opposite_nearest[]; };
layout(set = 0, binding = 6) writeonly buffer Fluxes { vec4 fluxes[]; };  // flux, greatest distance, number of fans

void main() {
  uint sphere = invocation_index();
  if (sphere >= sphere_count()) return;
  fluxes[sphere] = vec4(0.0);
  vec4 s = spheres[sphere];
  if (s.w < 0.0) return;
  float sum = 0.0, fans = 0.0, greatest = 0.0;
  uint samples_each = push.samples;
  for (uint k = 0u; k < samples_each; ++k) {
    uint index = samples_each * sphere + k;
    vec3 point = samples[index].xyz;
    vec3 to_boundary = nearest[index].xyz - point;
    vec3 direction = unit_or_zero(to_boundary);
    bool edge_or_vertex = opposites[index].w >= 0.0;
    vec3 from_opposite = edge_or_vertex ? opposite_nearest[index].xyz - opposites[index].xyz : vec3(0.0);
    bool fan = edge_or_vertex && distance(direction, unit_or_zero(from_opposite)) <= push.same_direction;
    sum += fan ? 0.0 : dot(direction, point - s.xyz) / s.w;
    fans += fan ? 1.0 : 0.0;
    greatest = max(greatest, length(to_boundary));
  }
  float used = float(samples_each) - fans;
  fluxes[sphere] = vec4(used > 0.0 ? sum / used : 0.0, greatest, fans, 0.0);
}
