// A power cell in units of its ball's radius, relative to its centre: a box, cut by one plane after the other (on the
// host: runtime/src/ball_unions/cells/power_cell.h). Three planes meet in every corner, as in N. Ray, D. Sokolov, S.
// Lefebvre, B. Levy, "Meshless Voronoi on the GPU", 2018. In contrast to that paper, a new corner lies on the edge that
// is cut, between the ends of that edge, and is therefore as close to the planes of the edge as these ends, up to one
// rounding. Whatever the angles of the planes, no corner is farther from its own planes, or beyond other planes, than
// its generation allows (docs/theory.md, "On the device").
#ifndef MEDIAL_VK_POWER_CELL_GLSL
#define MEDIAL_VK_POWER_CELL_GLSL

const float kRounding = 5.9604645e-8;   // 2^-24
const float kTie = 8.0 * kRounding;     // corners no higher than this over a plane are kept
const float kHeightRounding = 8.0 * kRounding;
const float kCornerRounding = 6.0 * kRounding;  // per generation
const float kBoxSide = 1.0625;          // the box's faces miss the ball despite rounding

vec4 corner[kMostCorners];        // w: height over the current cutting plane
uint corner_planes[kMostCorners]; // bytes: three planes, with det(normals) > 0, and the generation
uint corner_links[kMostCorners];  // bytes: byte k names the other end of the edge that is not in plane k
uint corner_count;
vec4 plane[kMostPlanes];          // normal . x <= w; the first six are the box's
uint plane_edges[kMostPlanes];    // bytes: for a cut, the corners that leave and arrive; above: the number of the cut
uvec2 free_planes;     // one bit for each
uint cuts;
float plane_error;     // greatest displacement of a plane by rounding
uint generations;      // greatest generation of a corner
bool cell_is_empty;
float beyond;          // of an empty cell: distance of its last corners beyond the plane
bool cell_failed;      // an array was too small, or rounding broke the cell
uint spent;            // iterations of loops so far

uint byte_of(uint word, uint k) { return word >> (8u * k) & 255u; }
uint with_byte(uint word, uint k, uint value) { return bitfieldInsert(word, value, int(8u * k), 8); }
uint with_name(uint word, uint old, uint name) {
  uint k = byte_of(word, 0u) == old ? 0u : byte_of(word, 1u) == old ? 1u : 2u;
  return with_byte(word, k, name);
}

uvec2 used_planes() {
  uvec2 used = uvec2(0u);
  for (uint c = 0u; c < corner_count; ++c) {
    uint planes = corner_planes[c];
    uint p = byte_of(planes, 0u), q = byte_of(planes, 1u), s = byte_of(planes, 2u);
    used[p >> 5] |= 1u << (p & 31u);
    used[q >> 5] |= 1u << (q & 31u);
    used[s >> 5] |= 1u << (s & 31u);
  }
  spent += corner_count;
  return used;
}

// Assigns a slot of `plane`: a cell has no more faces than corners.
uint take_plane() {
  if ((free_planes.x | free_planes.y) == 0u) free_planes = ~used_planes();
  uint p = free_planes.x != 0u ? findLSB(free_planes.x) : 32u + findLSB(free_planes.y);
  free_planes[p >> 5] &= ~(1u << (p & 31u));
  plane_edges[p] = 0u;
  return p;
}

void start_cell() {
  for (uint k = 0u; k < 6u; ++k) {
    vec3 normal = vec3(0.0);
    normal[k / 2u] = (k & 1u) == 0u ? -1.0 : 1.0;
    plane[k] = vec4(normal, kBoxSide);
    plane_edges[k] = 0u;
  }
  for (uint c = 0u; c < 8u; ++c) {
    bvec3 up = bvec3((c & 1u) != 0u, (c & 2u) != 0u, (c & 4u) != 0u);
    corner[c] = vec4(mix(vec3(-kBoxSide), vec3(kBoxSide), up), 0.0);
    uvec3 planes = uvec3(0u, 2u, 4u) + uvec3(up), links = uvec3(c ^ 1u, c ^ 2u, c ^ 4u);
    bool odd = c == 0u || c == 3u || c == 5u || c == 6u;  // an odd number of normals point downwards
    planes = odd ? planes.xzy : planes;
    links = odd ? links.xzy : links;
    corner_planes[c] = planes.x | planes.y << 8 | planes.z << 16;
    corner_links[c] = links.x | links.y << 8 | links.z << 16;
  }
  corner_count = 8u;
  free_planes = uvec2(~63u, ~0u);
  cuts = 0u;
  plane_error = 0.0;
  generations = 0u;
  cell_is_empty = false;
  cell_failed = false;
  beyond = 0.0;
  spent += 14u;
}

// Bound of the distance between the cell's surface and that of the true cell.
float displacement() {
  return kTie + kHeightRounding + plane_error + float(generations) * kCornerRounding;
}

#endif
