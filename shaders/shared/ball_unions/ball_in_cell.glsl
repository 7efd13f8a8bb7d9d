// The volume of a ball of radius 1, and the area of its sphere, in its power cell, in closed form and with error bounds
// (docs/theory.md, "Unions of balls" and "On the device"). Include power_cell.glsl before.
#ifndef MEDIAL_VK_BALL_IN_CELL_GLSL
#define MEDIAL_VK_BALL_IN_CELL_GLSL
#include "lanes/angle_of.glsl"

// Roundings of heights, gaps and positions along an edge, and of the terms computed from them.
const float kEdgeRounding = 24.0 * kRounding;
// For an edge this short, terms of its squared length are below one rounding.
const float kShortEdge = 6.1035156e-5;  // 2^-14
// Greatest growth of an arc at either end while the surface moves, more than sqrt(2 * displacement), and of a face, per
// edge.
const float kArcGrowth = 0.0078125;
const float kFaceGrowth = 0.00024414062;

// Compensated sums (Knuth): x is the sum, y the part that the additions lose.
vec2 volume_sum;
vec2 area_sum;
float volume_doubt;  // sum of the effect of one rounding on the terms, in units of kEdgeRounding
float area_doubt;
float flat_area;     // of the faces within the ball: the rate at which the volume changes if they move
float arc_angles;    // of the arcs on the faces: the same rate for the area

void add_to(inout vec2 sum, float term) {
  precise float total = sum.x + term;
  precise float of_term = total - sum.x;
  precise float lost = (sum.x - (total - of_term)) + (term - of_term);
  sum = vec2(total, sum.y + lost);
}

// The part [a, b] of an edge inside the ball, at gap g in a face at height h, contributes a pyramid.
void add_inside(float h, float g, float a, float b) {
  float size = max(b - a, 0.0);
  add_to(volume_sum, h * g * size / 6.0);
  volume_doubt += ((abs(h) + abs(g)) * size + abs(h * g)) / 6.0;
  flat_area += 0.5 * abs(g) * size;
}

// The integral of g / (rho (rho + h)) over [a, b], by the three-point rule of Gauss; since b - a <= 1/8 and rho >= 1,
// the remainder is below 2^-28 of the integral.
float short_integral(float h, float g, float f2, float a, float b) {
  float middle = 0.5 * (a + b), far = 0.38729833 * (b - a);
  vec3 t = vec3(middle - far, middle, middle + far);
  vec3 rho = sqrt(max(vec3(f2) + t * t, vec3(1.0)));
  vec3 weights = vec3(5.0, 8.0, 5.0) / 18.0;
  return (b - a) * dot(weights, vec3(g) / (rho * (rho + h)));
}

// Its antiderivative, which is 0 at 0.
float long_integral(float h, float g, float t, float rho) {
  return angle_of((rho + h) * (g * g * rho + h * t * t), t * g * (g * g + t * t));
}

// psi(b) - psi(a), with tan psi = h t / (g rho). If a and b have the same sign, b rho_a - a rho_b would cancel.
float psi_of(float h, float g, float f2, float a, float b, float rho_a, float rho_b) {
  float sum = b * rho_a + a * rho_b;
  float difference = a * b > 0.0 ? (b - a) * (b + a) * f2 / sum : b * rho_a - a * rho_b;
  return angle_of(g * g * rho_a * rho_b + h * h * a * b, h * g * difference);
}

// The part [a, b] of an edge outside the ball; f2: squared distance of the edge's line from the centre.
void add_outside(float height, float g, float f2, float a, float b) {
  float h = abs(height), size = b - a;
  float rho_a = sqrt(max(f2 + a * a, 1.0)), rho_b = sqrt(max(f2 + b * b, 1.0));
  float phi = angle_of(g * g + a * b, g * size);
  float low = min(h, 1.0), solid_angle, doubt = 0.0;
  if (h < 0.5) {
    solid_angle = h * phi - psi_of(h, g, f2, a, b, rho_a, rho_b);
  } else if (size <= 0.125) {
    solid_angle = (low - 1.0) * phi + short_integral(h, g, f2, a, b);
  } else {
    float of_a = long_integral(h, g, a, rho_a), of_b = long_integral(h, g, b, rho_b);
    solid_angle = (low - 1.0) * phi + (of_b - of_a);
    doubt = abs(of_a) + abs(of_b);
  }
  float arc = h < 1.0 ? abs(phi) : 0.0;
  doubt += low * abs(g) + (h < 1.0 ? (2.0 + h * abs(g)) * arc + 0.5 * h * size : (1.0 + abs(g)) * size);
  float disk = 0.5 * (1.0 - low * low) * phi;
  float signed_one = height < 0.0 ? -1.0 : 1.0;
  add_to(area_sum, signed_one * solid_angle);
  add_to(volume_sum, signed_one * (low * disk + solid_angle) / 3.0);
  area_doubt += doubt;
  volume_doubt += 0.5 * doubt;
  flat_area += abs(disk);
  arc_angles += arc;
  // A plane that barely misses the ball may in truth cut a cap off it.
  if (abs(h - 1.0) < kArcGrowth) arc_angles += 6.2831853;
}

// An edge too short for a meaningful direction: the integrands are evaluated at its middle. `moment`: twice the signed
// area of the triangle between the edge and the foot of the centre on the face's plane.
void add_point(float height, float moment, float r2, float size) {
  float h = abs(height), low = min(h, 1.0), rho = sqrt(r2);
  float beyond_disk = max(r2 - h * h, 1e-12);  // squared distance from the foot
  float of_disk = low * moment * clamp((1.0 - low * low) / beyond_disk, 0.0, 1.0);
  float solid_angle = moment * (h < 1.0 ? min(h * (rho - 1.0) / (rho * beyond_disk), 0.5) : 1.0 / (rho * (rho + h)));
  float signed_one = height < 0.0 ? -1.0 : 1.0;
  bool inside = r2 <= 1.0;
  add_to(area_sum, inside ? 0.0 : signed_one * solid_angle);
  add_to(volume_sum, inside ? height * moment / 6.0 : signed_one * (0.5 * of_disk + solid_angle) / 3.0);
  area_doubt += 4.0 * size;
  volume_doubt += 2.0 * size;
}

void measure_side(vec3 normal, vec3 direction, vec3 foot, float from, float to, float sense) {
  // A face is flat up to the displacement of its corners, so the plane through the edge that fits best is used.
  float tilt = dot(normal, direction), scale = inversesqrt(1.0 - tilt * tilt);
  float h = scale * dot(normal, foot), g = scale * sense * dot(cross(direction, normal), foot);
  float f2 = dot(foot, foot), half_chord = sqrt(max(1.0 - f2, 0.0));
  float enter = clamp(-half_chord, from, to), leave = clamp(half_chord, from, to);
  bool misses = f2 >= 1.0;
  if (!misses) add_inside(h, g, enter, leave);
  if (misses || enter > from) add_outside(h, g, f2, from, misses ? to : enter);
  if (!misses && leave < to) add_outside(h, g, f2, leave, to);
}

// The edge from corner `other` to corner c, in the faces of two planes.
void measure_edge(uint c, uint other, uint p, uint q) {
  precise vec3 begin = corner[other].xyz, along = corner[c].xyz - begin;
  float size = length(along);
  if (!(size > 0.0)) return;
  vec3 direction = along / size;
  float from = dot(direction, begin), to = from + size;
  vec3 foot = begin - from * direction, middle = begin + 0.5 * along;
  float f2 = dot(foot, foot), farthest = max(dot(begin, begin), dot(corner[c].xyz, corner[c].xyz));
  bool near_sphere = f2 < 1.0 + 2.0 * kArcGrowth && farthest > 1.0 - 2.0 * kArcGrowth;
  for (uint side = 0u; side < 2u; ++side) {
    vec3 normal = plane[side == 0u ? p : q].xyz;
    float sense = side == 0u ? 1.0 : -1.0;
    flat_area += kFaceGrowth;
    if (near_sphere) arc_angles += kArcGrowth;
    if (size > kShortEdge) {
      measure_side(normal, direction, foot, from, to, sense);
    } else {
      add_point(dot(normal, middle), sense * dot(cross(along, normal), begin), dot(middle, middle), size);
    }
  }
  spent += 3u;
}

// A polyhedron with three faces at each corner has V / 2 + 2 faces (Euler).
bool is_polyhedron() {
  ivec2 faces = bitCount(used_planes());
  return uint(faces.x + faces.y) * 2u == corner_count + 4u;
}

MeasuredBall measure_cell() {
  volume_sum = area_sum = vec2(0.0);
  volume_doubt = area_doubt = flat_area = arc_angles = 0.0;
  for (uint c = 0u; c < corner_count; ++c) {
    for (uint slot = 0u; slot < 3u; ++slot) {
      uint other = byte_of(corner_links[c], slot);
      if (other < c) continue;
      measure_edge(c, other, byte_of(corner_planes[c], (slot + 1u) % 3u), byte_of(corner_planes[c], (slot + 2u) % 3u));
    }
  }
  spent += 4u * corner_count;
  MeasuredBall found;
  found.volume = max(volume_sum.x + volume_sum.y, 0.0);
  found.area = max(area_sum.x + area_sum.y, 0.0);
  float moves = displacement();
  found.volume_bound = moves * flat_area + kEdgeRounding * volume_doubt;
  found.area_bound = moves * arc_angles + kEdgeRounding * area_doubt;
  return found;
}

#endif
