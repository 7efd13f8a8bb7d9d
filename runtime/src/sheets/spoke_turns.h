// Turns of spokes and normals from a medial point to its neighbour.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "base/point_ops.h"
#include "medial_vk/medial_spheres.h"
#include "sheets/tangent_frame.h"

namespace medial_vk {

inline double cosine(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
}

/// Cosine of the greater turn of the two spokes, paired such that it is smaller: the nearer one of the two contacts may
/// change from voxel to voxel.
inline double cosine_of_turn(const MedialSphere& p, const MedialSphere& q) {
  const double straight = std::min(cosine(p.spoke_a, q.spoke_a), cosine(p.spoke_b, q.spoke_b));
  const double crossed = std::min(cosine(p.spoke_a, q.spoke_b), cosine(p.spoke_b, q.spoke_a));
  return std::max(straight, crossed);
}

/// Cosine of the angle between the lines along the two normals.
inline double cosine_of_normals(const MedialSphere& p, const MedialSphere& q) {
  const Point a = sheet_normal(p), b = sheet_normal(q);
  return std::abs(dot(a, b)) / std::max(length(a) * length(b), 1e-300);
}

}  // namespace medial_vk
