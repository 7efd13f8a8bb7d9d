// The transformation of a node in double precision.
#pragma once

#include <array>

#include "medial_vk/mesh_view.h"

namespace medial_vk {

/// A matrix of three columns, and a translation: three rows of four numbers.
class AffineMap {
 public:
  using Rows = std::array<std::array<double, 4>, 3>;

  AffineMap() = default;
  explicit AffineMap(const Rows& rows) : rows_(rows) {}

  Point operator()(const Point& p) const {
    Point moved;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::array<double, 4>& row = rows_[i];
      moved[i] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
    }
    return moved;
  }

  /// First `inner`, then this.
  AffineMap operator*(const AffineMap& inner) const {
    AffineMap product;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        product.rows_[i][j] = j == 3 ? rows_[i][3] : 0;
        for (std::size_t k = 0; k < 3; ++k) product.rows_[i][j] += rows_[i][k] * inner.rows_[k][j];
      }
    }
    return product;
  }

  bool operator==(const AffineMap&) const = default;

  /// Negative for a reflection.
  double determinant() const {
    const Rows& m = rows_;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  }

  const Rows& rows() const { return rows_; }

 private:
  Rows rows_ = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
};

}  // namespace medial_vk
