#include "sphere_fits/cover/cover_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// Cells along the longest side of the box: at most 27,000 of them.
constexpr int kCells = 30;
constexpr int kTriangleDepth = 24;
constexpr std::uint32_t kLeaf = 12;

}  // namespace

CoverElements::CoverElements(const Solid& solid, std::size_t elements, const Threads& threads) {
  const Mesh& mesh = solid.mesh().mesh;
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    area += 0.5 * length(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]));
  }
  whole_area_ = area;
  // Elements whose longest side is between half of this and all of it have about that area on average.
  const double longest = 2 * std::sqrt(area / static_cast<double>(elements));
  for (const Triangle& t : mesh.triangles) {
    add_triangle(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], longest, 0);
  }
  add_cells(solid, threads);
  arrange();
}

void CoverElements::add_triangle(const Point& a, const Point& b, const Point& c, double longest, int depth) {
  const double ab = length(b - a), bc = length(c - b), ca = length(a - c);
  const double most = std::max({ab, bc, ca});
  if (most <= longest || depth == kTriangleDepth) {
    const std::array<Point, 3> corners = {a, b, c};
    return add(corners);
  }
  if (most == ab) {
    const Point m = 0.5 * (a + b);
    add_triangle(a, m, c, longest, depth + 1);
    add_triangle(m, b, c, longest, depth + 1);
  } else if (most == bc) {
    add_triangle(b, c, a, longest, depth);
  } else {
    add_triangle(c, a, b, longest, depth);
  }
}

void CoverElements::add_cells(const Solid& solid, const Threads& threads) {
  const MeshReport& report = solid.mesh().report;
  double side = 0;
  std::array<int, 3> count{};
  for (std::size_t k = 0; k < 3; ++k) side = std::max(side, (report.upper[k] - report.lower[k]) / kCells);
  for (std::size_t k = 0; k < 3; ++k) {
    count[k] = std::max(1, static_cast<int>(std::ceil((report.upper[k] - report.lower[k]) / side)));
  }
  const auto lower_of = [&](std::size_t cell) {
    const auto i = static_cast<int>(cell);
    const int row = i / count[0], layer = row / count[1];
    return report.lower + side * Point{static_cast<double>(i % count[0]), static_cast<double>(row % count[1]),
                                       static_cast<double>(layer)};
  };
  const auto all = static_cast<std::size_t>(count[0]) * count[1] * count[2];
  const double reach = side * std::sqrt(0.75);
  std::vector<std::uint8_t> is_inside(all);
  for_all(all, 64, threads, [&](std::size_t cell) {
    const Point centre = lower_of(cell) + side * Point{0.5, 0.5, 0.5};
    is_inside[cell] = !solid.bvh().any_within(centre, reach) && solid.contains(centre);
  });
  for (std::size_t cell = 0; cell < all; ++cell) {
    if (is_inside[cell] == 0) continue;
    const Point lower = lower_of(cell);
    std::array<Point, 8> corners;
    for (std::size_t k = 0; k < 8; ++k) {
      corners[k] = lower + side * Point{k & 1 ? 1.0 : 0.0, k & 2 ? 1.0 : 0.0, k & 4 ? 1.0 : 0.0};
    }
    add(corners);
  }
}

void CoverElements::add(std::span<const Point> points) {
  Point middle{};
  for (const Point& p : points) middle = middle + (1 / static_cast<double>(points.size())) * p;
  points_.insert(points_.end(), points.begin(), points.end());
  first_.push_back(static_cast<std::uint32_t>(points_.size()));
  middle_.push_back(middle);
  double squared = 0;
  for (const Point& p : points) squared = std::max(squared, dot(p - middle, p - middle));
  extent_.push_back(std::sqrt(squared));
  const Point twice = points.size() == 3 ? cross(points[1] - points[0], points[2] - points[0]) : Point{};
  const double size = length(twice);
  area_.push_back(size / 2);
  normal_.push_back(size > 0 ? (1 / size) * twice : Point{});
  distance_.push_back(0);
}

void CoverElements::add(std::span<const Probe> probes, double area) {
  for (const Probe& probe : probes) {
    add({&probe.at, 1});
    area_.back() = area / static_cast<double>(probes.size());
    normal_.back() = probe.direction;
    distance_.back() = probe.distance;
  }
  arrange();
}

void CoverElements::refine(const std::vector<bool>& which) {
  const std::vector<Point> points = std::move(points_), normals = std::move(normal_);
  const std::vector<double> areas = std::move(area_), distances = std::move(distance_);
  const std::vector<std::uint32_t> first = std::move(first_);
  points_.clear();
  first_.assign(1, 0);
  middle_.clear();
  extent_.clear();
  area_.clear();
  normal_.clear();
  distance_.clear();
  for (std::size_t element = 0; element + 1 < first.size(); ++element) {
    const std::span<const Point> p(points.data() + first[element], first[element + 1] - first[element]);
    if (!which[element] || p.size() != 3) {
      add(p);
      area_.back() = areas[element];
      normal_.back() = normals[element];
      distance_.back() = distances[element];
      continue;
    }
    const Point ab = 0.5 * (p[0] + p[1]), bc = 0.5 * (p[1] + p[2]), ca = 0.5 * (p[2] + p[0]);
    for (const std::array<Point, 3>& part : {std::array<Point, 3>{p[0], ab, ca}, std::array<Point, 3>{ab, p[1], bc},
                                             std::array<Point, 3>{ca, bc, p[2]}, std::array<Point, 3>{ab, bc, ca}}) {
      add(part);
    }
  }
  arrange();
}

void CoverElements::arrange() {
  std::vector<std::uint32_t> order(size());
  std::iota(order.begin(), order.end(), 0u);
  boxes_.clear();
  if (!order.empty()) arrange(0, static_cast<std::uint32_t>(size()), order);
  reorder(order);
  arranged_ = size();
}

/// Recursive halves, by the middle along the longest side of the box.
void CoverElements::arrange(std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& order) {
  const auto begin = order.begin() + first, end = begin + count;
  const std::size_t position = boxes_.size();
  Box box = {middle_[*begin], middle_[*begin], first, count, 0};
  for (auto at = begin; at != end; ++at) {
    for (std::size_t k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], middle_[*at][k]);
      box.upper[k] = std::max(box.upper[k], middle_[*at][k]);
    }
  }
  boxes_.push_back(box);
  if (count > kLeaf) {
    const Point side = box.upper - box.lower;
    const auto axis = static_cast<std::size_t>(std::max_element(side.begin(), side.end()) - side.begin());
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](std::uint32_t a, std::uint32_t b) {
      return middle_[a][axis] != middle_[b][axis] ? middle_[a][axis] < middle_[b][axis] : a < b;
    });
    boxes_[position].count = 0;
    arrange(first, half, order);
    arrange(first + half, count - half, order);
  }
  boxes_[position].next = static_cast<std::uint32_t>(boxes_.size());
}

void CoverElements::reorder(const std::vector<std::uint32_t>& order) {
  const auto reordered = [&](auto& values) {
    std::remove_reference_t<decltype(values)> next;
    next.reserve(order.size());
    for (const std::uint32_t element : order) next.push_back(values[element]);
    values = std::move(next);
  };
  std::vector<Point> all;
  std::vector<std::uint32_t> first = {0};
  all.reserve(points_.size());
  first.reserve(first_.size());
  for (const std::uint32_t element : order) {
    const std::span<const Point> own = points(element);
    all.insert(all.end(), own.begin(), own.end());
    first.push_back(static_cast<std::uint32_t>(all.size()));
  }
  points_ = std::move(all);
  first_ = std::move(first);
  reordered(middle_);
  reordered(extent_);
  reordered(area_);
  reordered(normal_);
  reordered(distance_);
}

bool CoverElements::is_in(const Ball& ball, std::uint32_t element) const {
  constexpr double kSure = 1 - 1e-12;  // beyond the rounding of these lengths
  const double sure = kSure * ball.radius - extent_[element];
  const Point d = middle_[element] - ball.centre;
  if (sure > 0 && dot(d, d) <= sure * sure) return true;
  return needed(ball.centre, element) <= ball.radius;
}

double CoverElements::needed(const Point& centre, std::span<const std::uint32_t> elements) const {
  double radius = 0;
  for (const std::uint32_t element : elements) {
    if (length(middle_[element] - centre) + extent_[element] >= radius)
      radius = std::max(radius, needed(centre, element));
  }
  return radius;
}

double CoverElements::needed(const Point& centre, std::uint32_t element) const {
  double squared = 0;
  for (const Point& p : points(element)) {
    const Point d = p - centre;
    squared = std::max(squared, dot(d, d));
  }
  return std::sqrt(squared);
}

void CoverElements::gather(const Ball& ball, std::vector<std::uint32_t>& found) const {
  found.clear();
  const double most = ball.radius * ball.radius;
  const auto take = [&](std::uint32_t element) {
    const Point d = middle_[element] - ball.centre;
    if (dot(d, d) <= most) found.push_back(element);
  };
  for (std::size_t position = 0; position < boxes_.size();) {
    const Box& box = boxes_[position];
    double away = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double out = std::max({box.lower[k] - ball.centre[k], ball.centre[k] - box.upper[k], 0.0});
      away += out * out;
    }
    if (away > most) {
      position = box.next;
      continue;
    }
    for (std::uint32_t element = box.first; element < box.first + box.count; ++element) take(element);
    ++position;
  }
  for (auto element = static_cast<std::uint32_t>(arranged_); element < size(); ++element) take(element);
}

}  // namespace medial_vk
