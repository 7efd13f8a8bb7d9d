// The data that triangles share with their neighbours, and the caps of spokes to vertices
// (runtime/src/indexed_mesh/mesh_links.h), from texel or storage buffers as for triangles. Include after "gpu_types.h"
// and "triangles.glsl", and define LINK_STORAGE_BINDING, LINK_TEXEL_BINDING, CORNER_STORAGE_BINDING and
// CORNER_TEXEL_BINDING before.
#ifndef MEDIAL_VK_LINKS_GLSL
#define MEDIAL_VK_LINKS_GLSL

layout(set = 0, binding = LINK_STORAGE_BINDING) readonly buffer LinkStorage { TriangleLinks link_storage[]; };
layout(set = 0, binding = CORNER_STORAGE_BINDING) readonly buffer CornerStorage { vec4 corner_storage[]; };
layout(set = 0, binding = LINK_TEXEL_BINDING) uniform usamplerBuffer link_texels;
layout(set = 0, binding = CORNER_TEXEL_BINDING) uniform samplerBuffer corner_texels;

// The rows of the caps of a triangle's corners, and its flags.
uvec4 corners_and_flags(uint t) {
  if (kUseTexels) return texelFetch(link_texels, int(2u * t));
  TriangleLinks l = link_storage[t];
  return uvec4(l.corner[0], l.corner[1], l.corner[2], l.flags);
}

uint neighbour_of(uint t, uint edge) {
  return kUseTexels ? texelFetch(link_texels, int(2u * t + 1u))[edge] : link_storage[t].neighbour[edge];
}

vec4 corner_cap(uint row) { return kUseTexels ? texelFetch(corner_texels, int(row)) : corner_storage[row]; }

#endif
