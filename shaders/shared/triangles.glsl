// Triangle data from a uniform texel buffer (much faster on lavapipe: loads with per-lane addresses are gathered) or
// from a storage buffer, where the mesh has more texels than the device allows in a view.
// Before including, define TRIANGLE_STORAGE_BINDING and TRIANGLE_TEXEL_BINDING.
#include "closest_point.glsl"

layout(constant_id = 1) const bool kUseTexels = true;
layout(set = 0, binding = TRIANGLE_STORAGE_BINDING) readonly buffer TriangleStorage { vec4 triangle_storage[]; };
layout(set = 0, binding = TRIANGLE_TEXEL_BINDING) uniform samplerBuffer triangle_texels;

vec4 triangle_texel(uint i) { return kUseTexels ? texelFetch(triangle_texels, int(i)) : triangle_storage[i]; }

TriangleTexels load_triangle(uint t) {
  return TriangleTexels(triangle_texel(4 * t), triangle_texel(4 * t + 1), triangle_texel(4 * t + 2),
                        triangle_texel(4 * t + 3));
}
