// Decides whether a medial point touches a face from outside (docs/theory.md, Lemma K). For cells in which
// measure_levels.comp has stored a winding number. Include after "carriers.glsl".
#ifndef MEDIAL_VK_FOOT_SIDES_GLSL
#define MEDIAL_VK_FOOT_SIDES_GLSL

// Number of entries that an invocation examines here: the loop budget of lavapipe (tree.glsl) is shared by eight of
// them.
const uint kMostCrossingTests = 1024u;
uint crossing_tests = 0u;

const int kUnclear = 2;

// The change of the winding number at the crossing of a triangle by the segment from the origin to y, with the triangle
// relative to the same origin: -1 from behind to in front; 0 if the segment does not cross it. Unclear next to sides
// and ends.
int crossing(TriangleTexels t, vec3 p, vec3 y) {
  float size = length(y), clear = 4.0 * step.slack + tilt_of(t) * (length(p) + size);
  float before = dot(t.normal.xyz, p), after = dot(t.normal.xyz, p - y);
  if (min(before, after) > clear || max(before, after) < -clear) return 0;
  vec3 corner[3] = vec3[3](p, p + t.ab.xyz, p + t.ac.xyz);
  bool left = false, right = false, all_clear = true;
  for (uint k = 0u; k < 3u; ++k) {
    vec3 from = corner[k], side = corner[(k + 1u) % 3u] - from, across = cross(from, side);
    float volume = dot(across, y);
    float error = step.slack * (size * (length(side) + length(from)) + length(across));
    left = left || volume > error;
    right = right || volume < -error;
    all_clear = all_clear && abs(volume) > error;
  }
  if (left && right) return 0;
  if (!all_clear || min(abs(before), abs(after)) <= clear) return kUnclear;
  return before > 0.0 ? -1 : 1;
}

// unpackHalf2x16(), for which LLVM 15 has no code on 64-bit ARM in this kernel. Exact, subnormal numbers included; `bits` are
// those of a finite number.
float half_of(uint bits) {
  uint fraction = bits & 0x3ffu, exponent = (bits >> 10) & 31u;
  float size = exponent == 0u ? float(fraction) * 5.9604644775390625e-8  // 2^-24
                              : uintBitsToFloat(((exponent + 112u) << 23) | (fraction << 13));
  return (bits & 0x8000u) == 0u ? size : -size;
}

// Lemma K for one face: the winding number on that side of it, near all points of the cell that touch it, is below 1/2.
bool is_outside_at(uint name, Cell cell, vec3 centre, float nearest_distance) {
  uint t = name / 8u, kind = name % 8u, flags = corners_and_flags(t).w;
  TriangleTexels face = load_triangle(t);
  bool is_face = (kind == kFace || kind == kFront) && (flags & kLinkWhole) == 0u;
  if (!is_face || (flags & kLinkUncrossed) == 0u) return false;
  vec3 p = face.a.xyz - centre, foot = vector_to_triangle(centre, face);
  vec3 inwards = p + (face.ab.xyz + face.ac.xyz) / 3.0 - foot;
  float rho = step.circumradius, away = length(inwards);
  float share = min(0.5, 0.5 * rho / max(away, 1e-30)), depth = dot(face.normal.xyz, p);
  vec3 y = foot + share * inwards;
  crossing_tests += cell.list_count;
  bool reached = length(y) + 2.0 * step.slack <= min(step.list_radius, 3.0 * rho);
  bool is_beside = abs(depth) > 4.0 * step.slack + tilt_of(face) * length(p);
  if (!reached || !is_beside || crossing_tests > kMostCrossingTests) return false;
  vec2 measured = vec2(half_of(cell.winding & 0xffffu), half_of(cell.winding >> 16));
  float winding = measured.x;
  for (uint i = 0u; i < cell.list_count; ++i) {
    uint other = lists[cell.list_begin + i];
    if (other == t) continue;
    TriangleTexels texels = load_triangle(other);
    int change = crossing(texels, texels.a.xyz - centre, y);
    if (change == kUnclear) return false;
    winding += float(change);
  }
  bool from_behind = depth > 0.0, in_front = kind == kFront;
  if (from_behind != !in_front) winding += in_front ? -1.0 : 1.0;
  float way = length(y) + share * away + nearest_distance + 2.0 * rho + 4.0 * step.slack;
  return winding + measured.y * way / rho < 0.5;
}

bool is_outside_pair(uint first, uint second, Cell cell, float nearest_distance) {
  if ((cell.flags & kCellMeasured) == 0u) return false;
  vec3 centre = cell_centre(uvec3(cell.x, cell.y, cell.z));
  bool outside = false;
  for (uint k = 0u; k < 2u;) {  // a loop, so that drivers translate its body once
    outside = is_outside_at(k == 0u ? first : second, cell, centre, nearest_distance);
    if (outside || ++k == 2u) break;
  }
  return outside;
}

#endif
