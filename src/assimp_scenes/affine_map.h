// The transformation of a node in double precision.
#pragma once

#include <assimp/matrix4x4.h>
#include <assimp/vector3.h>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

inline Point point_of(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// A matrix of three columns, and a translation. The last row of assimp's matrices is that of an affine map.
class AffineMap {
 public:
  AffineMap() = default;
  explicit AffineMap(const aiMatrix4x4& m) {
    for (unsigned row = 0; row < 3; ++row) {
      for (unsigned column = 0; column < 4; ++column) entries_[row][column] = static_cast<double>(m[row][column]);
    }
  }

  Point operator()(const Point& p) const {
    Point moved;
    for (int i = 0; i < 3; ++i) {
      const double* row = entries_[i];
      moved[i] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    }
    return moved;
  }

  /// First `inner`, then this.
  AffineMap operator*(const AffineMap& inner) const {
    AffineMap product;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 4; ++j) {
        product.entries_[i][j] = j == 3 ? entries_[i][3] : 0;
        for (int k = 0; k < 3; ++k) product.entries_[i][j] += entries_[i][k] * inner.entries_[k][j];
      }
    }
    return product;
  }

  /// Negative for a reflection.
  double determinant() const {
    const auto& m = entries_;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }

 private:
  double entries_[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

}  // namespace medial_vk
