// The surface of a frame, as kernels of balls read it, and the arrays of the balls. All of these kernels have the same
// buffers.
//
// A triangle is four vectors: its corners, with the inverse squares of the lengths of the edges 01, 02 and 12 (0 for an
// edge without length), and its unit normal (0 without a meaningful area), with the height of the corners above the plane
// through the triangle's middle. Its bounds are that middle, and the distance of the farthest corner from it.
//
// A node of the tree is eight places for children, of two vectors each: the lower corner of the box as bits, and the
// leaf, or the node that it leads to (less than 2^24; nodes below one node follow each other, and come before leaves);
// the upper corner, and the next place that is not below this one. Unused places have empty boxes. Node 0 has one place,
// with the box around all triangles, and leads to node 1.
#ifndef MEDIAL_VK_FOLLOWING_FRAME_GLSL
#define MEDIAL_VK_FOLLOWING_FRAME_GLSL
#include "follow_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push { FollowConstants push; };
layout(set = 0, binding = 0) readonly buffer TriangleStorage { vec4 triangle_storage[]; };
layout(set = 0, binding = 1) readonly buffer NodeStorage { uvec4 node_storage[]; };
layout(set = 0, binding = 2) buffer Lists { uint lists[]; };
layout(set = 0, binding = 3) readonly buffer Rests { uvec4 rest_storage[]; };  // FollowRest
layout(set = 0, binding = 4) buffer States { uvec4 states[]; };  // FollowState, after the last frame
layout(set = 0, binding = 5) buffer Found { uvec4 found[]; };    // FollowedBall, in this one
layout(set = 0, binding = 6) buffer Sides { uint sides[]; };
layout(set = 0, binding = 7) buffer Unresolved { uint unresolved[]; };
layout(set = 0, binding = 8) writeonly buffer Balls { vec4 balls[]; };
layout(set = 0, binding = 9) writeonly buffer BallStates { uint ball_states[]; };
layout(set = 0, binding = 10) readonly buffer BoundStorage { vec4 bound_storage[]; };
layout(set = 0, binding = 11) uniform samplerBuffer triangle_texels;
layout(set = 0, binding = 12) uniform samplerBuffer bound_texels;
layout(set = 0, binding = 13) uniform usamplerBuffer node_texels;
layout(set = 0, binding = 14) uniform usamplerBuffer rest_texels;
layout(set = 0, binding = 15) uniform usamplerBuffer state_texels;
layout(set = 0, binding = 16) uniform usamplerBuffer found_texels;

// Texels take a fraction of the time on lavapipe (tree/triangles.glsl).
#ifdef STORAGE
const bool kUseTexels = false;
#else
const bool kUseTexels = true;
#endif
vec4 triangle_vector(uint i) { return kUseTexels ? texelFetch(triangle_texels, int(i)) : triangle_storage[i]; }
vec4 bounds_of(uint triangle) { return kUseTexels ? texelFetch(bound_texels, int(triangle)) : bound_storage[triangle]; }
uvec4 node_vector(uint i) { return kUseTexels ? texelFetch(node_texels, int(i)) : node_storage[i]; }

uvec4 rest_vector(uint i) { return kUseTexels ? texelFetch(rest_texels, int(i)) : rest_storage[i]; }
uvec4 state_vector(uint i) { return kUseTexels ? texelFetch(state_texels, int(i)) : states[i]; }
uvec4 found_vector(uint i) { return kUseTexels ? texelFetch(found_texels, int(i)) : found[i]; }

vec4 found_ball(uint ball) { return uintBitsToFloat(found_vector(kFollowedVectors * ball + 3u)); }
float rest_radius_of(uint ball) { return uintBitsToFloat(rest_vector(kRestVectors * ball + 3u).w); }
// FollowRest from `through` on.
uvec4 last_of_rest(uint ball) { return rest_vector(kRestVectors * ball + 6u); }

uint invocation_index() { return workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x; }

uint list_entry(uint list, uint index) { return lists[kFollowLists + (list - kFollowAgain) * push.ball_count + index]; }
void append(uint list, uint entry) {
  uint index = atomicAdd(lists[list], 1u);
  if (index % kFollowGroup == 0u) atomicAdd(lists[kFollowGroups + 3u * (list - kFollowAgain)], 1u);
  lists[kFollowLists + (list - kFollowAgain) * push.ball_count + index] = entry;
}

// Of the box around all triangles: its longest side, and this plus the greatest coordinate.
float longest_side() {
  vec3 sides = uintBitsToFloat(node_vector(1u).xyz) - uintBitsToFloat(node_vector(0u).xyz);
  return max(sides.x, max(sides.y, sides.z));
}
float greatest_length() {
  vec3 far = max(abs(uintBitsToFloat(node_vector(0u).xyz)), abs(uintBitsToFloat(node_vector(1u).xyz)));
  return longest_side() + max(far.x, max(far.y, far.z));
}

bool is_refused() {
  float side = longest_side();
  return lists[kFollowRefused] != 0u || !(side >= kLeastFollowSide && side <= kMostFollowSide);
}

// Bounds of rounding (docs/theory.md, "Balls on the device"), in units of greatest_length(): by which a ball ends before
// the surface, so that its own contact is not found in it; the rounding of its distance; the least radius.
const float kContactSlack = 16.0 * 1.1920929e-7;
const float kDistanceRounding = 32.0 * 1.1920929e-7;
const float kLeastRadius = 64.0 * 1.1920929e-7;

struct Corners {
  vec3 a, b, c;
};

Corners corners_of(uint triangle) {
  return Corners(triangle_vector(4u * triangle).xyz, triangle_vector(4u * triangle + 1u).xyz, triangle_vector(4u * triangle + 2u).xyz);
}
// Towards the inside; 0 without a meaningful area.
vec3 inward_normal(uint triangle) { return -triangle_vector(4u * triangle + 3u).xyz; }

// Of length 1, or 0.
vec3 unit_or_zero(vec3 v) {
  float square = dot(v, v);
  return square > 1e-30 ? inversesqrt(square) * v : vec3(0.0);
}

#endif
