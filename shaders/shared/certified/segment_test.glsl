// The triangles that may be nearest to some point of a segment (docs/theory.md, "Segments"). Include step.glsl before.
#ifndef MEDIAL_VK_SEGMENT_TEST_GLSL
#define MEDIAL_VK_SEGMENT_TEST_GLSL

// A segment from p to q, and the distances of its ends from two triangles: along it, no distance exceeds the chord.
struct Segment {
  vec3 along;  // unit, or 0 if p and q are one point
  float extent;
  vec2 from_first, from_second;  // distances at p and q, with a margin for the points that are queried
};

Segment segment_between(vec3 p, vec3 q, vec2 from_first, vec2 from_second) {
  // Points within epsilon of the segment are queried too (growth test): both distances may differ by as much.
  float room = 2.0 * (step.epsilon + 4.0 * step.slack);
  return Segment(unit_or_zero(q - p), distance(p, q), from_first + room, from_second + room);
}

// True if offset + slope s <= 0 for some s between the bounds, which it narrows.
void narrow(float offset, float slope, inout vec2 bounds) {
  float root = -offset / (abs(slope) < 1e-12 ? 1e-12 : slope);
  bounds.y = slope > 0.0 || abs(slope) < 1e-12 ? min(bounds.y, root) : bounds.y;
  bounds.x = slope <= -1e-12 ? max(bounds.x, root) : bounds.x;
}

// v_p, v_q: vectors from the ends to the triangle, of lengths d_p and d_q. Between the ends the triangle is no nearer
// than either tangent. The error of the directions is up to 2 slack / d.
bool may_be_nearest_on(Segment s, vec3 v_p, float d_p, vec3 v_q, float d_q) {
  float per_p = 1.0 / max(d_p, 1e-30), per_q = 1.0 / max(d_q, 1e-30), per_length = 1.0 / max(s.extent, 1e-30);
  float slope_p = -dot(v_p, s.along) * per_p, slope_q = -dot(v_q, s.along) * per_q;
  float tilt = 2.0 * step.slack * s.extent;
  float start_p = d_p - tilt * per_p, start_q = d_q - tilt * per_q - slope_q * s.extent;  // of the tangents, at p
  float slope_first = (s.from_first.y - s.from_first.x) * per_length;
  float slope_second = (s.from_second.y - s.from_second.x) * per_length;
  vec2 bounds = vec2(0.0, s.extent);
  narrow(start_p - s.from_first.x, slope_p - slope_first, bounds);
  narrow(start_p - s.from_second.x, slope_p - slope_second, bounds);
  narrow(start_q - s.from_first.x, slope_q - slope_first, bounds);
  narrow(start_q - s.from_second.x, slope_q - slope_second, bounds);
  return bounds.x <= bounds.y;
}

#endif
