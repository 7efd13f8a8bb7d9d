#include "surface_nets.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace medial_vk::bench {
namespace {

using Eigen::Vector3d;
using Index = std::array<std::size_t, 3>;

constexpr std::uint32_t kNoVertex = 0xffffffffu;

class Grid {
 public:
  Grid(const std::function<double(const Vector3d&)>& function, const Vector3d& low, const Vector3d& high,
       double spacing)
      : low_(low), spacing_(spacing) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      size_[k] = static_cast<std::size_t>(std::ceil((high[axis] - low[axis]) / spacing)) + 1;
    }
    values_.reserve(size_[0] * size_[1] * size_[2]);
    for_each([&](const Index& at) { values_.push_back(function(place(at))); });
  }

  Mesh mesh() {
    Mesh mesh;
    vertices_.assign(values_.size(), kNoVertex);
    for_each([&](const Index& at) { add_vertex(at, mesh); });
    for_each([&](const Index& at) {
      for (std::size_t axis = 0; axis < 3; ++axis) add_triangles(at, axis, mesh);
    });
    return mesh;
  }

 private:
  template <class Body>
  void for_each(const Body& body) const {
    for (std::size_t x = 0; x < size_[0]; ++x) {
      for (std::size_t y = 0; y < size_[1]; ++y) {
        for (std::size_t z = 0; z < size_[2]; ++z) body(Index{x, y, z});
      }
    }
  }
  std::size_t number(const Index& at) const { return (at[0] * size_[1] + at[1]) * size_[2] + at[2]; }
  Vector3d place(const Index& at) const {
    return low_ +
           spacing_ * Vector3d(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2]));
  }
  double value(const Index& at) const { return values_[number(at)]; }
  static Index next(Index at, std::size_t axis) {
    ++at[axis];
    return at;
  }

  /// Of the cube whose lowest corner that is.
  void add_vertex(const Index& at, Mesh& mesh) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (at[k] + 1 == size_[k]) return;
    }
    Vector3d sum = Vector3d::Zero();
    int crossings = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) {
        Index from = at;
        from[(axis + 1) % 3] += static_cast<std::size_t>(corner & 1);
        from[(axis + 2) % 3] += static_cast<std::size_t>(corner >> 1);
        const Index to = next(from, axis);
        const double a = value(from), b = value(to);
        if ((a < 0) == (b < 0)) continue;
        sum += place(from) + a / (a - b) * (place(to) - place(from));
        ++crossings;
      }
    }
    if (crossings == 0) return;
    vertices_[number(at)] = static_cast<std::uint32_t>(mesh.vertices.size());
    sum /= crossings;
    mesh.vertices.push_back({sum.x(), sum.y(), sum.z()});
  }

  /// Of the edge from there along the axis, with a vertex in each of the four cubes around it.
  void add_triangles(const Index& at, std::size_t axis, Mesh& mesh) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (at[axis] + 1 == size_[axis] || at[u] == 0 || at[v] == 0) return;
    const bool inside = value(at) < 0;
    if (inside == (value(next(at, axis)) < 0)) return;
    const auto vertex = [&](std::size_t back_u, std::size_t back_v) {
      Index cube = at;
      cube[u] -= back_u;
      cube[v] -= back_v;
      return vertices_[number(cube)];
    };
    std::array quad = {vertex(0, 0), vertex(1, 0), vertex(1, 1), vertex(0, 1)};  // about the axis
    if (!inside) std::swap(quad[1], quad[3]);
    mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    mesh.triangles.push_back({quad[0], quad[2], quad[3]});
  }

  Vector3d low_;
  double spacing_;
  Index size_{};
  std::vector<double> values_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace

Mesh surface_nets(const std::function<double(const Vector3d&)>& function, const Vector3d& low, const Vector3d& high,
                  double spacing) {
  return Grid(function, low, high, spacing).mesh();
}

}  // namespace medial_vk::bench
