// The winding number of a point by rays with certain signs. Include frame.glsl before.
//
// For a ray along x, coordinates across it are u = y - p x and v = z - q x, with fixed numbers p and q that no edge of
// an ordinary mesh is parallel to. A triangle crosses the ray if the origin is on the same side of its three edges in
// the plane of u and v, and crosses it ahead of the point if a sum of products is positive. All signs have bounds of
// their rounding (docs/theory.md, "Balls on the device"); where one is not certain, another ray decides.
#ifndef MEDIAL_VK_FOLLOWING_RAY_GLSL
#define MEDIAL_VK_FOLLOWING_RAY_GLSL

const uint kRayDirections = 4u;
const uint kRayDescents = 8u;
#ifndef RAY_ROUNDS
#define RAY_ROUNDS 3300u  // of all directions; each is at most kRayDescents nodes, a leaf, and the ends of three loops
#endif
const float kSideRounding = 12.0 * 1.1920929e-7;
const float kAheadRounding = 16.0 * 1.1920929e-7;
const float kUnderflow = 1e-36;

vec3 ray_origin;
uint ray_direction;
uint ray_rounds = 0u;
int ray_number;
bool ray_is_certain;

// Cyclic, so that orientations stay.
vec3 along_ray(vec3 v) {
  uint axis = ray_direction % 3u;
  return axis == 0u ? v.xyz : (axis == 1u ? v.yzx : v.zxy);
}
vec2 ray_slopes() { return ray_direction < 3u ? vec2(0.3819660, 0.2360680) : vec2(-0.2763932, 0.4472136); }

// x along the ray, u, v; and the sums of the magnitudes from which u and v are computed.
struct OnRay {
  vec3 p;
  vec2 sizes;
};
OnRay on_ray(vec3 corner) {
  vec3 s = along_ray(corner - ray_origin);
  vec2 tilt = ray_slopes() * s.x;
  return OnRay(vec3(s.x, s.yz - tilt), abs(s.yz) + abs(tilt));
}

// Twice the area of the triangle of the origin, a and b in the plane across the ray, and a bound of its rounding.
vec2 side_of(OnRay a, OnRay b) {
  return vec2(a.p.y * b.p.z - a.p.z * b.p.y, a.sizes.x * b.sizes.y + a.sizes.y * b.sizes.x);
}

void count_crossing(uint triangle) {
  Corners t = corners_of(triangle);
  OnRay a = on_ray(t.a), b = on_ray(t.b), c = on_ray(t.c);
  vec2 of_a = side_of(b, c), of_b = side_of(c, a), of_c = side_of(a, b);
  vec3 sides = vec3(of_a.x, of_b.x, of_c.x), sizes = vec3(of_a.y, of_b.y, of_c.y);
  vec3 bounds = kSideRounding * sizes + kUnderflow;
  bvec3 is_left = greaterThan(sides, bounds), is_right = lessThan(sides, -bounds);
  vec3 ahead = vec3(a.p.x, b.p.x, c.p.x);
  float sum = dot(sides, ahead), bound = kAheadRounding * dot(sizes, abs(ahead)) + kUnderflow;
  bool is_beside = any(is_left) && any(is_right), is_behind = max(ahead.x, max(ahead.y, ahead.z)) < 0.0;
  bool crosses = all(is_left) || all(is_right);
  int sign_of_sum = all(is_left) ? 1 : -1;
  bool is_ahead = float(sign_of_sum) * sum > bound, is_back = float(sign_of_sum) * sum < -bound;
  bool is_none = is_beside || is_behind || (crosses && is_back);
  bool is_one = !is_none && crosses && is_ahead;
  ray_number += is_one ? sign_of_sum : 0;
  ray_is_certain = ray_is_certain && (is_none || is_one);
}

bool ray_meets(vec3 lower_corner, vec3 upper_corner) {
  vec3 lower = along_ray(lower_corner - ray_origin), upper = along_ray(upper_corner - ray_origin);
  vec2 slopes = ray_slopes();
  vec2 one = slopes * lower.x, other = slopes * upper.x;
  vec2 least = lower.yz - max(one, other), most = upper.yz - min(one, other);
  vec2 margin = 8.0 * 1.1920929e-7 * (abs(lower.yz) + abs(upper.yz) + abs(one) + abs(other)) + kUnderflow;
  return upper.x >= 0.0 && all(lessThanEqual(least, margin)) && all(greaterThanEqual(most, -margin));
}

void follow_ray() {
  ray_number = 0;
  ray_is_certain = true;
  uint position = 0u, end = push.place_count;
  while (position < end) {
    uint leaf = 0u, descents = 0u;
    while (descents < kRayDescents) {
      uvec4 lower = node_vector(2u * position), upper = node_vector(2u * position + 1u);
      bool meets = ray_meets(uintBitsToFloat(lower.xyz), uintBitsToFloat(upper.xyz));
      leaf = meets && lower.w >= 1u << kFollowLeafBits ? lower.w : 0u;
      position = meets && lower.w < 1u << kFollowLeafBits ? kFollowArity * lower.w : upper.w;
      if (leaf != 0u || position >= end || ++descents == kRayDescents) break;
    }
    uint i = leaf & ((1u << kFollowLeafBits) - 1u), leaf_end = i + (leaf >> kFollowLeafBits);
    while (i < leaf_end) count_crossing(i++);
    if (position >= end || !ray_is_certain || ++ray_rounds >= RAY_ROUNDS) break;
  }
  ray_is_certain = ray_is_certain && position >= end;
}

// True if the point, which is not on the surface, is certain to have a positive winding number.
bool is_inside(vec3 point) {
  ray_origin = point;
  ray_direction = 0u;
  bool inside = false;
  while (ray_direction < kRayDirections) {
    follow_ray();
    inside = ray_is_certain && ray_number > 0;
    ++ray_direction;
    if (ray_is_certain || ray_rounds >= RAY_ROUNDS) break;
  }
  return inside;
}

#endif
