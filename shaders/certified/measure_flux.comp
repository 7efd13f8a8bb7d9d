#version 450
#extension GL_GOOGLE_include_directive : enable
// Average outward flux of the gradient of the distance transform (equation 2.4) through the sphere around a voxel: the
// sum of choose_opposites.comp, and the samples whose queried opposites show that they are not two-sided fans
// (Definition 2.4).
#include "certified/step.glsl"
#include "certified/flux_samples.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 7
#include "tree/triangles.glsl"

layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) buffer FoundPoints { FoundPoint found[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 4) readonly buffer Opposites { vec4 opposites[]; };
layout(set = 0, binding = 5) readonly buffer OppositeNearest { uvec2 opposite_nearest[]; };
layout(set = 0, binding = 6) readonly buffer Tallies { vec4 tallies[]; };

void main() {
  uint index = invocation_index();
  uint item = step.first_item + index;
  if (item >= counters[kFound]) return;
  vec3 centre = voxel_centre(found[item]);
  float sum = tallies[index].x, used = tallies[index].y;
  uint count = uint(tallies[index].z), base = kFluxSamples * index;
  for (uint k = 0u; k < count; ++k) {
    vec4 opposite = opposites[base + k];
    uint s = uint(opposite.w);
    vec3 p = sample_point(centre, s);
    vec3 g = unit_or_zero(vector_to_triangle(p, load_triangle(nearest[base + s].y)));
    vec3 theirs = unit_or_zero(vector_to_triangle(opposite.xyz, load_triangle(opposite_nearest[base + k].y)));
    bool fan = dot(g, theirs) > kSameDirection;
    sum += fan ? 0.0 : dot(g, p - centre) / step.voxel_size;
    used += fan ? 0.0 : 1.0;
  }
  found[item].spoke_b.w = used > 0.0 ? sum / used : 0.0;
}
