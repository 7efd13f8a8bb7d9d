// Points and transformations of assimp in double precision.
#pragma once

#include <assimp/matrix4x4.h>
#include <assimp/vector3.h>

#include "scene_files/affine_map.h"

namespace medial_vk {

inline Point point_of(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// The last row of assimp's matrices is that of an affine map.
inline AffineMap affine_map_of(const aiMatrix4x4& m) {
  AffineMap::Rows rows;
  for (unsigned row = 0; row < 3; ++row) {
    for (unsigned column = 0; column < 4; ++column) rows[row][column] = static_cast<double>(m[row][column]);
  }
  return AffineMap(rows);
}

}  // namespace medial_vk
