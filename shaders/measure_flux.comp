#version 450
#extension GL_GOOGLE_include_directive : enable
// Average outward flux of the gradient of the distance transform (equation 2.4) through the sphere around a voxel,
// without two-sided fans (Definition 2.4): samples nearest to an edge or a vertex whose opposite sees the same
// direction.
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 7
#include "triangles.glsl"

layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) buffer FoundPoints { FoundPoint found[]; };
layout(set = 0, binding = 3) readonly buffer Samples { vec4 samples[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 5) readonly buffer Opposites { vec4 opposites[]; };
layout(set = 0, binding = 6) readonly buffer OppositeNearest { uvec2 opposite_nearest[]; };

const float kSameDirection = 1.0 - 1e-6;  // cosine; directions are good to about 1e-4

void main() {
  uint index = invocation_index();
  uint item = step.first_item + index;
  if (item >= counters[kFound]) return;
  vec3 centre = (vec3(found[item].voxel_x, found[item].voxel_y, found[item].voxel_z) + 0.5) * step.voxel_size;
  float sum = 0.0;
  float used = 0.0;
  for (uint k = 0; k < kFluxSamples; ++k) {
    uint s = kFluxSamples * index + k;
    vec3 point = samples[s].xyz;
    TriangleTexels texels = load_triangle(nearest[s].y);
    vec3 v = vector_to_triangle(point, texels);
    vec3 g = unit_or_zero(v);
    vec3 opposite = unit_or_zero(vector_to_triangle(opposites[s].xyz, load_triangle(opposite_nearest[s].y)));
    bool on_face = abs(dot(g, texels.normal.xyz)) > kSameDirection;
    bool fan = !on_face && dot(g, opposite) > kSameDirection;
    sum += fan ? 0.0 : dot(g, point - centre) / step.voxel_size;
    used += fan ? 0.0 : 1.0;
  }
  found[item].spoke_b.w = used > 0.0 ? sum / used : 0.0;
}
