#version 450
#extension GL_GOOGLE_include_directive : enable
// Determines the samples of the flux (equation 2.4) that are two-sided fans (Definition 2.4): nearest to an edge or a
// vertex, with the same direction at the opposite. Most require no query. A sample nearest to the interior of a face is
// not a fan. A sample whose opposite lies on the segment to its nearest point is a fan, since all points of that
// segment have the same nearest point. The opposites of the other samples are queried, in groups.
#include "certified/step.glsl"
#include "certified/flux_samples.glsl"
#define TRIANGLE_STORAGE_BINDING 0
#define TRIANGLE_TEXEL_BINDING 7
#include "tree/triangles.glsl"

layout(set = 0, binding = 1) buffer Counters { uint counters[]; };
layout(set = 0, binding = 2) readonly buffer FoundPoints { FoundPoint found[]; };
layout(set = 0, binding = 3) readonly buffer Nearest { uvec2 nearest[]; };
layout(set = 0, binding = 4) writeonly buffer Opposites { vec4 opposites[]; };  // w: the sample
layout(set = 0, binding = 5) writeonly buffer Tallies { vec4 tallies[]; };
layout(set = 0, binding = 6) writeonly buffer Requests { uint requests[]; };  // groups of kFluxGroup opposites

void main() {
  uint index = invocation_index();
  uint item = step.first_item + index;
  if (item >= counters[kFound]) return;
  vec3 centre = voxel_centre(found[item]);
  float sum = 0.0, used = 0.0;
  uint count = 0u, base = kFluxSamples * index;
  vec4 last = vec4(0.0);
  for (uint k = 0u; k < kFluxSamples; ++k) {
    vec3 p = sample_point(centre, k), from_centre = p - centre;
    TriangleTexels texels = load_triangle(nearest[base + k].y);
    vec3 to_boundary = vector_to_triangle(p, texels);
    vec3 g = unit_or_zero(to_boundary);
    float outward = dot(g, from_centre);
    bool on_segment = outward <= 0.0 && -2.0 * outward <= length(to_boundary);
    bool on_face = abs(dot(g, texels.normal.xyz)) > kSameDirection;
    sum += on_face ? outward / step.voxel_size : 0.0;
    used += on_face ? 1.0 : 0.0;
    if (!on_face && !on_segment) {
      last = vec4(centre + from_centre - 2.0 * outward * g, float(k));
      opposites[base + count++] = last;
    }
  }
  uint groups = (count + kFluxGroup - 1u) / kFluxGroup;
  for (uint k = count; k < groups * kFluxGroup; ++k) opposites[base + k] = last;
  tallies[index] = vec4(sum, used, float(count), 0.0);
  uint slot = atomicAdd(counters[kRequests], groups);  // in any order: every result is written to its own slot
  for (uint k = 0u; k < groups; ++k) requests[slot + k] = (base / kFluxGroup) + k;
}
