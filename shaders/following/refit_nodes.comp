#version 450
#extension GL_GOOGLE_include_directive : enable
// The boxes of the leaves, level 0 of the tree, or of another level, an invocation for each place of a child; or of several
// levels, the upper ones, by a single workgroup. All places below a place are in lower levels. Boxes are exact.
#include "follow_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const bool kLeaves = false;
layout(constant_id = 2) const bool kSeveralLevels = false;
layout(push_constant) uniform Push { RefitConstants push; };
layout(set = 0, binding = 0) readonly buffer Triangles { vec4 triangles[]; };
layout(set = 0, binding = 1) coherent buffer Nodes { uvec4 nodes[]; };
layout(set = 0, binding = 2) readonly buffer Levels { uint levels[]; };  // where levels start in it; places by level

void refit(uint place) {
  uint link = nodes[2u * place].w;
  vec3 lower = vec3(3e38), upper = vec3(-3e38);
  uint triangle = link & ((1u << kFollowLeafBits) - 1u), end = triangle + (kLeaves ? link >> kFollowLeafBits : 0u);
  while (triangle < end) {
    vec3 a = triangles[4u * triangle].xyz, b = triangles[4u * triangle + 1u].xyz, c = triangles[4u * triangle + 2u].xyz;
    lower = min(lower, min(a, min(b, c)));
    upper = max(upper, max(a, max(b, c)));
    ++triangle;
  }
  // Boxes of unused places are empty.
  uint child = kFollowArity * link, end_child = kLeaves ? child : child + kFollowArity;
  while (child < end_child) {
    lower = min(lower, uintBitsToFloat(nodes[2u * child].xyz));
    upper = max(upper, uintBitsToFloat(nodes[2u * child + 1u].xyz));
    ++child;
  }
  nodes[2u * place].xyz = floatBitsToUint(lower);
  nodes[2u * place + 1u].xyz = floatBitsToUint(upper);
}

void main() {
  if (!kSeveralLevels) {
    uint i = levels[push.first_level] + workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (i < levels[push.first_level + 1u]) refit(levels[i]);
    return;
  }
  for (uint level = push.first_level; level < push.end_level; ++level) {
    uint end = levels[level + 1u];
    for (uint i = levels[level] + gl_LocalInvocationID.x; i < end; i += gl_WorkGroupSize.x) refit(levels[i]);
    memoryBarrierBuffer();
    barrier();
  }
}
