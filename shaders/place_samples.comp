#version 450
#extension GL_GOOGLE_include_directive : enable
// The points at which flux is sampled, on the sphere around a voxel's centre with the voxel's side as radius: a spiral
// that turns by the golden angle.
#include "step.glsl"
#include "flux_samples.glsl"

layout(set = 0, binding = 0) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 1) readonly buffer FoundPoints { FoundPoint found[]; };
layout(set = 0, binding = 2) writeonly buffer Samples { vec4 samples[]; };

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
  samples[index] = vec4(voxel_centre(found[item]) + step.voxel_size * spiral_direction(index % kFluxSamples), 0.0);
}
