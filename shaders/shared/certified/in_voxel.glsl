// The test whether a point may represent its voxel. Include "step.glsl" before.
#ifndef MEDIAL_VK_IN_VOXEL_GLSL
#define MEDIAL_VK_IN_VOXEL_GLSL

// With a small margin, so that the point is in the voxel in double precision too.
bool is_in_voxel(vec3 p, Cell cell) {
  vec3 x = p - finest_voxel_corner(cell);
  float margin = 1e-4 * step.voxel_size + 0.25 * step.slack;
  return all(greaterThan(x, vec3(margin))) && all(lessThan(x, vec3(step.voxel_size - margin)));
}

#endif
