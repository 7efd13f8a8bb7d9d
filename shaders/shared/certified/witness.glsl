// Lemma A (docs/theory.md): the triangles that may hold the nearest boundary point of some point of a cell. A witness
// is any part of the boundary with which they are compared. Good witnesses are near the centre of the cell, or near the
// opposite point of its ball: where a sheet passes, the two lie on its two sides. Include step.glsl before.
#ifndef MEDIAL_VK_WITNESS_GLSL
#define MEDIAL_VK_WITNESS_GLSL

const float kTurnSlack = 2e-6;
const uint kWitnessSample = 128;  // most entries among which witnesses are sought; of long lists at least half as many

struct Witness {
  uint name;
  float distance;
  vec3 direction;
  float clear_distance, square_sum, square_slope;  // is_contact
  float to_corner[8];  // distances from the corners of the cube, if the cube is tested
};

// `v`: from the centre to its nearest point.
Witness witness_at(uint name, vec3 v) {
  Witness w;
  w.name = name;
  w.distance = length(v);
  w.direction = unit_or_zero(v);
  float radius = step.list_radius;
  // dist(m, w) <= D - g.x + |x|^2 / (2 D); D <= R: only the plain bound holds.
  bool far = w.distance > radius;
  w.clear_distance = w.distance + 6.0 * step.slack + (far ? radius * radius / (2.0 * w.distance) : 0.0);
  w.square_sum = radius * radius * (far ? 2.0 + kTurnSlack : 4.0);
  w.square_slope = radius * radius * (far ? 2.0 : 0.0);
  return w;
}

// Lemma A for the ball of the list: true if a convex set at distance d in direction g from the centre may be nearest to
// a point of the ball. Squares are compared: |g - g_w|^2 = 2 - 2 g.g_w (docs/theory.md, "Rounding").
bool is_contact(Witness w, float d, vec3 g) {
  float excess = d - w.clear_distance;
  bool near = excess <= 0.0, turned = excess * excess <= w.square_sum - w.square_slope * dot(g, w.direction);
  return near || turned;
}

// Lemma A for the cube, whose corners have these extents along g: at some corner x_k, D - g.x_k <= dist(x_k, witness).
bool touches_cube(Witness w, float d, vec4 along) {
  return most_at_corners(w.to_corner, along) >= d - distance_slack(d, 1.7321 * step.touch_half_side);
}

// Lemma L: a point of the solid with a spoke to a trusted triangle lies nearly straight behind it. It is applied if the
// whole ball of the list lies in the solid.
struct Prism {
  bool is_tested;
  float spokes;  // bound of the length of the spokes of a point of the ball, with a margin
};

// `clearance`: the distance from the centre to the boundary, or a lower bound.
bool clears_boundary(float clearance) {
  return step.open_edges == 0u && clearance > step.list_radius + 2.0 * step.slack;
}

// `distance`: that distance, or an upper bound.
Prism prism_at(float distance, bool is_tested) { return Prism(is_tested, distance + 2.0 * step.list_radius); }

// Greatest distance beside a triangle of the points that have spokes to it.
float room_beside(Prism prism, vec4 normal) {
  float room = 8.0 * step.slack + prism.spokes * (normal.w - 1.0);
  bool is_trusted = normal.w > 0.5;
  return prism.is_tested && is_trusted ? room : 1e15;
}

// `v`: from the centre to the nearest point of the triangle.
vec3 beside(vec3 v, vec4 normal) { return v - dot(v, normal.xyz) * normal.xyz; }

bool is_contact(Prism prism, vec3 v, vec4 normal) {
  vec3 aside = beside(v, normal);
  float reach = step.list_radius + room_beside(prism, normal);
  return dot(aside, aside) <= reach * reach;
}

// The cube extends in direction `aside` by its half-sides times the components of that direction.
bool touches_cube(Prism prism, vec3 v, vec4 normal) {
  vec3 aside = beside(v, normal);
  float reach = length(aside) * room_beside(prism, normal) + step.touch_half_side * dot(abs(aside), vec3(1.0));
  return dot(aside, aside) <= reach;
}

// True if voxels of the cell are in the grid and in the block that is searched. Cells and blocks are cubes of 2^k voxels
// at multiples of their sides, so one contains the other or they are apart.
bool is_searched(uvec3 coordinates) {
  uvec3 voxel = coordinates * step.voxels_per_cell;
  uvec3 block = uvec3(step.block_xy & 0xffffu, step.block_xy >> 16, step.block_z & 0xffffu);
  uint shift = max(step.block_z >> 16, uint(findMSB(step.voxels_per_cell)));
  bool is_in_block = all(equal(voxel >> shift, block >> shift));
  bool is_in_grid = all(lessThan(voxel, uvec3(step.grid_x, step.grid_y, step.grid_z)));
  bool is_below = step.depth > 0u;
  return is_below || (is_in_block && is_in_grid);
}

#endif
