// The part of a line that is examined. Include "step.glsl" before.
#ifndef MEDIAL_VK_CLIP_LINE_GLSL
#define MEDIAL_VK_CLIP_LINE_GLSL

// The part of the line through centre + base that lies in the cell's ball and in the finest voxel, both enlarged by
// epsilon: a point within epsilon of the medial surface may represent a sheet that runs along a face of its voxel, just
// outside. Only ends inside the voxel are accepted (verify_line.glsl).
bool clip_line(Cell cell, vec3 centre, vec3 base, vec3 direction, out float from, out float to) {
  vec3 lower = finest_voxel_corner(cell) - step.epsilon, upper = lower + step.voxel_size + 2.0 * step.epsilon;
  vec3 point = centre + base;
  vec3 a = (lower - point) / direction, b = (upper - point) / direction;
  vec3 low = min(a, b), high = max(a, b);
  float radius = step.circumradius + step.epsilon;
  float along = dot(base, direction);
  float half_chord = sqrt(max(0.0, along * along - dot(base, base) + radius * radius));
  from = -along - half_chord;
  to = -along + half_chord;
  for (uint k = 0; k < 3u; ++k) {
    bool parallel = abs(direction[k]) < 1e-6;
    if (parallel && (point[k] <= lower[k] || point[k] >= upper[k])) return false;
    from = parallel ? from : max(from, low[k]);
    to = parallel ? to : min(to, high[k]);
  }
  return to > from;
}

#endif
