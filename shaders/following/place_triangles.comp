#version 450
#extension GL_GOOGLE_include_directive : enable
// The triangles of a frame, from the vertices that the caller has written: shaders/shared/following/frame.glsl.
#include "follow_types.h"
#include "lanes/workgroup_index.glsl"

layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push { RefitConstants push; };
layout(set = 0, binding = 0) readonly buffer Vertices { float coordinates[]; };
layout(set = 0, binding = 1) readonly buffer Indices { uint indices[]; };  // three for each triangle
layout(set = 0, binding = 2) writeonly buffer Triangles { vec4 triangles[]; };
layout(set = 0, binding = 3) buffer Lists { uint lists[]; };

// The scale is a power of two, so that products are exact.
vec3 vertex(uint index) {
  return push.scale * vec3(coordinates[3u * index], coordinates[3u * index + 1u], coordinates[3u * index + 2u]);
}

bool is_in_range(vec3 p) {
  bvec3 is_finite = notEqual(floatBitsToUint(p) & 0x7f800000u, uvec3(0x7f800000u));
  return all(is_finite) && all(lessThanEqual(abs(p), vec3(kMostFollowCoordinate)));
}

float inverse_square(vec3 edge) {
  float square = dot(edge, edge);
  return square > 1e-30 ? 1.0 / square : 0.0;
}

// A unit vector, or 0 where rounding leaves no direction.
vec3 normal_of(vec3 ab, vec3 ac) {
  const float kMeaningful = 6.1e-5;  // of the sine of the angle between both
  vec3 area = cross(ab, ac);
  float square = dot(area, area);
  bool has_area = square > kMeaningful * kMeaningful * dot(ab, ab) * dot(ac, ac) && square > 1e-30;
  return has_area ? inversesqrt(square) * area : vec3(0.0);
}

void main() {
  uint triangle = workgroup_index() * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  if (triangle >= push.triangle_count) return;
  vec3 a = vertex(indices[3u * triangle]), b = vertex(indices[3u * triangle + 1u]),
       c = vertex(indices[3u * triangle + 2u]);
  if (!is_in_range(a) || !is_in_range(b) || !is_in_range(c)) atomicOr(lists[kFollowRefused], 1u);
  vec3 ab = b - a, ac = c - a;
  triangles[4u * triangle] = vec4(a, inverse_square(ab));
  triangles[4u * triangle + 1u] = vec4(b, inverse_square(ac));
  triangles[4u * triangle + 2u] = vec4(c, inverse_square(c - b));
  triangles[4u * triangle + 3u] = vec4(normal_of(ab, ac), 0.0);
}
