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
layout(set = 0, binding = 4) writeonly buffer Bounds { vec4 bounds[]; };

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

// The middle of the longest edge, or the mean of the corners: of the balls around both that hold the triangle, the smaller
// one counts. That around the former is the least of all unless all angles are acute.
vec3 middle_of(vec3 a, vec3 b, vec3 c) {
  float ab = dot(b - a, b - a), ac = dot(c - a, c - a), bc = dot(c - b, c - b);
  vec3 opposite = bc >= max(ab, ac) ? a : (ac >= ab ? b : c);
  vec3 middle = 0.5 * (a + b + c - opposite);
  vec3 mean = (a + b + c) * 0.33333333;
  float longest = max(bc, max(ab, ac));
  float to_opposite = 4.0 * dot(opposite - middle, opposite - middle);
  vec3 to_a = a - mean, to_b = b - mean, to_c = c - mean;
  float far = 4.0 * max(dot(to_a, to_a), max(dot(to_b, to_b), dot(to_c, to_c)));
  return max(longest, to_opposite) < far ? middle : mean;
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
  vec3 normal = normal_of(ab, ac), middle = middle_of(a, b, c);
  vec3 to_a = a - middle, to_b = b - middle, to_c = c - middle;
  float height = max(abs(dot(normal, to_a)), max(abs(dot(normal, to_b)), abs(dot(normal, to_c))));
  triangles[4u * triangle + 3u] = vec4(normal, height);
  bounds[triangle] = vec4(middle, sqrt(max(dot(to_a, to_a), max(dot(to_b, to_b), dot(to_c, to_c)))));
}
