#include "mesh/winding/winding_number.h"

#include <numbers>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Expand from this many radii on. Measured: see the unit test WindingNumber.TreeAgreesWithSum.
constexpr double kFarRadii = 2.5;

Point centroid(const std::array<Point, 3>& t) {
  // By differences, so that far from the origin it stays within rounding of the triangle's plane.
  return t[0] + (1.0 / 3) * ((t[1] - t[0]) + (t[2] - t[0]));
}

}  // namespace

double triangle_winding(const std::array<Point, 3>& triangle, const Point& p) {
  const Point a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  const double numerator = dot(a, cross(b, c));
  const double denominator = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return std::atan2(numerator, denominator) / (2 * std::numbers::pi);
}

double exact_winding_number(const Mesh& mesh, const Point& p) {
  CompensatedSum sum;
  for (const Triangle& t : mesh.triangles) {
    sum.add(triangle_winding({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, p));
  }
  return sum.value();
}

WindingTree::WindingTree(const TriangleTree& tree) : tree_(tree), nodes_(tree.nodes.size()) {
  // Children follow their parents: in reverse order, all descendants of a node are finished before it.
  std::vector<double> weight(nodes_.size(), 0);  // area
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const TriangleTree::Node& node = tree.nodes[i];
    Expansion& e = nodes_[i];
    e.is_leaf = node.left == 0;
    e.first = node.first;
    e.count = node.count;
    e.left = node.left;
    e.right = node.right;
    e.area = {0, 0, 0};
    e.moment.fill(0);
    Point mean = {0, 0, 0};  // relative to the box, weighted by area
    const Point& origin = node.box.lower;
    if (e.is_leaf) {
      for (std::uint32_t position = node.first; position < node.first + node.count; ++position) {
        const auto& t = tree.corners[position];
        const Point n = 0.5 * cross(t[1] - t[0], t[2] - t[0]);
        const double area = length(n);
        weight[i] += area;
        mean = mean + area * (centroid(t) - origin);
        e.area = e.area + n;
      }
    } else {
      for (const std::uint32_t child : {node.left, node.right}) {
        weight[i] += weight[child];
        mean = mean + weight[child] * (nodes_[child].centre - origin);
        e.area = e.area + nodes_[child].area;
      }
    }
    e.centre = weight[i] > 0 ? origin + (1 / weight[i]) * mean : origin;
    const auto add_moment = [&](const Point& n, const Point& at) {
      const Point d = at - e.centre;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) e.moment[3 * r + c] += n[r] * d[c];
      }
    };
    if (e.is_leaf) {
      for (std::uint32_t position = node.first; position < node.first + node.count; ++position) {
        const auto& t = tree.corners[position];
        add_moment(0.5 * cross(t[1] - t[0], t[2] - t[0]), centroid(t));
      }
    } else {
      for (const std::uint32_t child : {node.left, node.right}) {
        add_moment(nodes_[child].area, nodes_[child].centre);
        for (int k = 0; k < 9; ++k) e.moment[k] += nodes_[child].moment[k];
      }
    }
    double radius_squared = 0;  // to the farthest corner of the box
    for (int k = 0; k < 3; ++k) {
      const double reach = std::max(node.box.upper[k] - e.centre[k], e.centre[k] - node.box.lower[k]);
      radius_squared += reach * reach;
    }
    e.far_squared = kFarRadii * kFarRadii * radius_squared;
  }
}

double WindingTree::sum(const Point& p, std::uint32_t without, std::uint64_t& cost) const {
  if (nodes_.empty()) return 0;
  double far = 0, near = 0;
  constexpr std::size_t kDepth = 128;  // 95 levels at most, see TriangleTree
  std::array<std::uint32_t, kDepth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Expansion& e = nodes_[stack[--size]];
    const Point r = e.centre - p;
    const double squared = dot(r, r);
    if (squared > e.far_squared) {
      // grad of r / |r|^3: (I - 3 r r^T / |r|^2) / |r|^3.
      const auto& m = e.moment;
      const double trace = m[0] + m[4] + m[8];
      const double along = r[0] * (m[0] * r[0] + m[1] * r[1] + m[2] * r[2]) +
                           r[1] * (m[3] * r[0] + m[4] * r[1] + m[5] * r[2]) +
                           r[2] * (m[6] * r[0] + m[7] * r[1] + m[8] * r[2]);
      far += (dot(e.area, r) + trace - 3 * along / squared) / (squared * std::sqrt(squared));
    } else if (e.is_leaf) {
      cost += e.count;
      for (std::uint32_t position = e.first; position < e.first + e.count; ++position) {
        if (position != without) near += triangle_winding(tree_.corners[position], p);
      }
    } else {
      stack[size++] = e.right;
      stack[size++] = e.left;
    }
  }
  return far / (4 * std::numbers::pi) + near;
}

double WindingTree::beside(std::uint32_t position, std::uint64_t& cost) const {
  return sum(centroid(tree_.corners[position]), position, cost);
}

}  // namespace medial_vk
