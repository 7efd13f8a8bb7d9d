// Triangle data from a uniform texel buffer (much faster on lavapipe: loads with per-lane addresses become gathers) or
// from a storage buffer, if the mesh has more texels than the device allows in a view: kernels that include this are
// compiled twice, the second time with STORAGE.
// Before including, define TRIANGLE_STORAGE_BINDING and TRIANGLE_TEXEL_BINDING.
#include "tree/closest_point.glsl"

#ifdef STORAGE
const bool kUseTexels = false;
#else
const bool kUseTexels = true;
#endif
layout(set = 0, binding = TRIANGLE_STORAGE_BINDING) readonly buffer TriangleStorage { vec4 triangle_storage[]; };
layout(set = 0, binding = TRIANGLE_TEXEL_BINDING) uniform samplerBuffer triangle_texels;

vec4 triangle_texel(uint i) { return kUseTexels ? texelFetch(triangle_texels, int(i)) : triangle_storage[i]; }

// Greatest turn of a triangle by the rounding of its corners (6e-8 each): docs/theory.md, "Rounding".
float tilt_of(TriangleTexels t) {
  vec3 bc = t.ac.xyz - t.ab.xyz;
  float longest = max(dot(bc, bc), max(dot(t.ab.xyz, t.ab.xyz), dot(t.ac.xyz, t.ac.xyz)));
  return min(1.2e-7 * sqrt(longest) / max(length(cross(t.ab.xyz, t.ac.xyz)), 1e-30), 1.0);
}

TriangleTexels load_triangle(uint t) {
  return TriangleTexels(triangle_texel(4 * t), triangle_texel(4 * t + 1), triangle_texel(4 * t + 2),
                        triangle_texel(4 * t + 3));
}
