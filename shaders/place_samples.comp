#version 450
#extension GL_GOOGLE_include_directive : enable
// The points at which flux is sampled, on the sphere around a voxel's centre with the voxel's side as radius: a spiral
// that turns by the golden angle; or, second, the opposites of those points (Definition 2.3).
#include "step.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 6
#include "triangles.glsl"

layout(constant_id = 2) const bool kOpposite = false;

layout(set = 0, binding = 1) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer FoundPoints { FoundPoint found[]; };
layout(set = 0, binding = 3) readonly buffer Samples { vec4 samples[]; };
layout(set = 0, binding = 4) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 5) writeonly buffer Points { vec4 points[]; };

vec3 spiral_direction(uint k) {
  // The source's spiral (its [102]) advances the azimuth by 3.6 / sqrt(N (1 - h^2)), a sum without a closed form; the
  // golden angle spreads the points as evenly.
  float h = (2.0 * float(k) + 1.0) / float(kFluxSamples) - 1.0;
  float azimuth = float(k) * 2.399963;
  float r = sqrt(1.0 - h * h);
  return vec3(r * cos(azimuth), r * sin(azimuth), h);
}

void main() {
  uint index = invocation_index();
  uint item = step.first_item + index / kFluxSamples;
  if (item >= counters[kFound]) return;
  vec3 centre = (vec3(found[item].voxel_x, found[item].voxel_y, found[item].voxel_z) + 0.5) * step.voxel_size;
  if (!kOpposite) {
    points[index] = vec4(centre + step.voxel_size * spiral_direction(index % kFluxSamples), 0.0);
    return;
  }
  vec3 point = samples[index].xyz;
  vec3 direction = unit_or_zero(vector_to_triangle(point, load_triangle(nearest[index].y)));
  points[index] = vec4(point - 2.0 * dot(point - centre, direction) * direction, 0.0);
}
