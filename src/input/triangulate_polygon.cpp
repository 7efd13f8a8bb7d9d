// Ear clipping (Meisters 1975) in the plane of two coordinates. The dropped coordinate is that of the largest component
// of the Newell normal: dropping one coordinate instead of rotating leaves the other two as they are in the file, so
// that corners on a line stay on it. Every corner is used, also one in the middle of a straight side: the neighbouring
// face has it too, and without it a crack would open.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "input/polygon_soup.h"

namespace medial_vk {
namespace {

struct Point2 {
  double x, y;
  bool operator==(const Point2&) const = default;
};

/// Twice the signed area of (a, b, c), or 0 where rounding could have determined the sign: with u = 2^-53 the
/// differences carry u each, the products one more, the subtraction another; 4u of the sum of magnitudes bounds it
/// (Shewchuk 1997, the first filter of orient2d: 3u + 16u^2).
double area_of(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (b.x - a.x) * (c.y - a.y);
  const double right = (b.y - a.y) * (c.x - a.x);
  const double area = left - right;
  return std::abs(area) > 4.5e-16 * (std::abs(left) + std::abs(right)) ? area : 0;
}

/// A uniform grid over the corners, for polygons that are long enough to benefit.
class CornerGrid {
 public:
  void build(const std::vector<Point2>& points) {
    lower_ = upper_ = points[0];
    for (const Point2& p : points) {
      lower_ = {std::min(lower_.x, p.x), std::min(lower_.y, p.y)};
      upper_ = {std::max(upper_.x, p.x), std::max(upper_.y, p.y)};
    }
    side_ = std::max<std::ptrdiff_t>(1, static_cast<std::ptrdiff_t>(std::sqrt(static_cast<double>(points.size()))));
    starts_.assign(static_cast<std::size_t>(side_ * side_) + 1, 0);
    for (const Point2& p : points) ++starts_[cell(column(p.x), row(p.y)) + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    items_.resize(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      items_[next[cell(column(points[i].x), row(points[i].y))]++] = i;
    }
  }

  /// Calls visit(i) for the corners near the box until it returns true, which is the result. Subtracts every visited
  /// cell from `work_left`.
  template <class Visit>
  bool any(const Point2& lower, const Point2& upper, std::int64_t& work_left, Visit visit) const {
    for (std::ptrdiff_t r = row(lower.y); r <= row(upper.y); ++r) {
      for (std::ptrdiff_t c = column(lower.x); c <= column(upper.x); ++c) {
        --work_left;
        const std::size_t at = cell(c, r);
        for (std::uint32_t i = starts_[at]; i < starts_[at + 1]; ++i) {
          if (visit(items_[i])) return true;
        }
      }
    }
    return false;
  }

 private:
  std::ptrdiff_t step(double t, double low, double high) const {
    const double s = (t - low) / (high - low) * static_cast<double>(side_);
    if (!(s > 0)) return 0;  // also if all corners lie on one line, or the extent overflows
    return s < static_cast<double>(side_) ? static_cast<std::ptrdiff_t>(s) : side_ - 1;
  }
  std::ptrdiff_t column(double x) const { return step(x, lower_.x, upper_.x); }
  std::ptrdiff_t row(double y) const { return step(y, lower_.y, upper_.y); }
  std::size_t cell(std::ptrdiff_t c, std::ptrdiff_t r) const { return static_cast<std::size_t>(r * side_ + c); }

  Point2 lower_ = {0, 0}, upper_ = {0, 0};
  std::ptrdiff_t side_ = 1;
  std::vector<std::uint32_t> starts_, items_;
};

class EarClipper {
 public:
  EarClipper(std::vector<Point2> points, std::vector<std::uint32_t> corners, std::int64_t& work_left)
      : points_(std::move(points)), corners_(std::move(corners)), work_left_(work_left) {
    const auto n = static_cast<std::uint32_t>(points_.size());
    next_.resize(n);
    previous_.resize(n);
    alive_.assign(n, true);
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      previous_[i] = (i + n - 1) % n;
    }
    left_ = n;
    constexpr std::uint32_t kGridPays = 48;
    if (n >= kGridPays) grid_.build(points_);
    use_grid_ = n >= kGridPays;
  }

  bool clip(std::vector<Triangle>& triangles) {
    std::uint32_t at = 0, tried = 0;
    while (left_ > 3) {
      if (--work_left_ < 0) return false;
      if (is_ear(at)) {
        emit(at, triangles);
        remove(at);
        at = next_[next_[at]];  // not the neighbour: that would make a fan of needles
        tried = 0;
      } else {
        at = next_[at];
        if (++tried <= left_) continue;
        // No corner can be cut off. A corner on a line with its neighbours, or a spike, bounds no area: one of these is
        // left out.
        std::uint32_t flat = at;
        for (std::uint32_t i = 0; i < left_ && area(flat) != 0; ++i, --work_left_) flat = next_[flat];
        if (area(flat) != 0) return false;
        at = next_[flat];
        remove(flat);
        tried = 0;
      }
    }
    const double last = area(at);
    if (last > 0) emit(at, triangles);
    return last >= 0;
  }

 private:
  double area(std::uint32_t i) const { return area_of(points_[previous_[i]], points_[i], points_[next_[i]]); }

  void emit(std::uint32_t i, std::vector<Triangle>& triangles) const {
    triangles.push_back({corners_[previous_[i]], corners_[i], corners_[next_[i]]});
  }

  void remove(std::uint32_t i) {
    next_[previous_[i]] = next_[i];
    previous_[next_[i]] = previous_[i];
    alive_[i] = false;
    --left_;
  }

  bool is_ear(std::uint32_t i) {
    if (!(area(i) > 0)) return false;
    const Point2 &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
    const auto blocks = [&](std::uint32_t j) {
      --work_left_;
      if (!alive_[j] || j == i || j == previous_[i] || j == next_[i]) return false;
      const Point2& p = points_[j];
      // A repeated point (the bridge to a hole) blocks only if its own sides enter the ear.
      if (p == a || p == b || p == c) return leads_into(j, a, b, c);
      return area_of(a, b, p) >= 0 && area_of(b, c, p) >= 0 && area_of(c, a, p) >= 0;
    };
    if (use_grid_) {
      const Point2 lower = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
      const Point2 upper = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
      return !grid_.any(lower, upper, work_left_, blocks);
    }
    for (std::uint32_t j = next_[next_[i]]; j != previous_[i]; j = next_[j]) {
      if (blocks(j)) return false;
    }
    return true;
  }

  /// True if a side at corner j, which lies on a corner of the triangle, enters the interior of the triangle.
  bool leads_into(std::uint32_t j, const Point2& a, const Point2& b, const Point2& c) const {
    const Point2& p = points_[j];
    const Point2& left = p == a ? b : p == b ? c : a;  // the triangle's wedge at p, counter-clockwise from here
    const Point2& right = p == a ? c : p == b ? a : b;
    const auto between = [&](const Point2& to) { return area_of(p, left, to) > 0 && area_of(p, to, right) > 0; };
    return between(points_[previous_[j]]) || between(points_[next_[j]]);
  }

  std::vector<Point2> points_;
  std::vector<std::uint32_t> corners_, next_, previous_;
  std::vector<bool> alive_;
  std::int64_t& work_left_;
  std::uint32_t left_ = 0;
  CornerGrid grid_;
  bool use_grid_ = false;
};

/// Newell's normal: the sum of the cross products around the first corner, twice the vector area.
Point newell_normal(const std::vector<Point>& vertices, const std::uint32_t* corners, std::uint32_t size) {
  Point normal = {0, 0, 0};
  const Point& origin = vertices[corners[0]];
  for (std::uint32_t i = 1; i + 1 < size; ++i) {
    Point e, f;
    for (int k = 0; k < 3; ++k) {
      e[k] = vertices[corners[i]][k] - origin[k];
      f[k] = vertices[corners[i + 1]][k] - origin[k];
    }
    for (int k = 0; k < 3; ++k) normal[k] += e[(k + 1) % 3] * f[(k + 2) % 3] - e[(k + 2) % 3] * f[(k + 1) % 3];
  }
  return normal;
}

double squared_distance(const Point& a, const Point& b) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

}  // namespace

bool triangulate_polygon(const std::vector<Point>& vertices, const std::uint32_t* corners, std::uint32_t size,
                         std::int64_t& work_left, std::vector<Triangle>& triangles) {
  if (size == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return true;
  }
  const Point normal = newell_normal(vertices, corners, size);
  int drop = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[drop])) drop = k;
  }
  int u = (drop + 1) % 3, v = (drop + 2) % 3;
  if (normal[drop] < 0) std::swap(u, v);  // counter-clockwise in (u, v)

  std::vector<Point2> points;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < size; ++i) {
    const Point& p = vertices[corners[i]];
    if (!kept.empty() && vertices[kept.back()] == p) continue;
    points.push_back({p[u], p[v]});
    kept.push_back(corners[i]);
  }
  while (kept.size() > 1 && vertices[kept.back()] == vertices[kept.front()]) {
    kept.pop_back();
    points.pop_back();
  }
  if (kept.size() < 3) {  // of zero area: cleaning drops and counts it
    triangles.push_back({corners[0], corners[1], corners[2]});
    return true;
  }
  if (kept.size() == 4) {  // start such that the shorter of the two diagonals is cut first
    const double first = squared_distance(vertices[kept[0]], vertices[kept[2]]);
    const double second = squared_distance(vertices[kept[1]], vertices[kept[3]]);
    if (second >= first) {
      std::rotate(points.begin(), points.begin() + 1, points.end());
      std::rotate(kept.begin(), kept.begin() + 1, kept.end());
    }
  }
  if (normal != Point{0, 0, 0}) {
    const std::size_t before = triangles.size();
    EarClipper clipper(std::move(points), kept, work_left);
    if (clipper.clip(triangles)) return true;
    triangles.resize(before);
  }
  for (std::size_t i = 1; i + 1 < kept.size(); ++i) triangles.push_back({kept[0], kept[i], kept[i + 1]});
  return false;
}

Mesh triangulate(PolygonSoup soup) {
  Mesh mesh;
  mesh.triangles.reserve(soup.sizes.size());
  // A circle of a million corners takes 330 visits per corner, a spiral of 8000 takes 18000. A tangle with many corners
  // on a line takes the square of its length per corner: hours for a file of 1 MB. So beyond an allowance per polygon,
  // all polygons together have a few seconds: a visit takes 5 to 10 ns.
  constexpr std::int64_t kLooksPerCorner = 400;
  std::int64_t reserve = 400'000'000;
  const std::uint32_t* corners = soup.corners.data();
  for (const std::uint32_t size : soup.sizes) {
    if (size < 3) {
      ++mesh.short_polygons;
    } else {
      std::int64_t work_left = reserve + kLooksPerCorner * size;
      if (!triangulate_polygon(soup.vertices, corners, size, work_left, mesh.triangles)) ++mesh.fallback_polygons;
      reserve = std::clamp<std::int64_t>(work_left, 0, reserve);
    }
    corners += size;
  }
  mesh.vertices = std::move(soup.vertices);
  return mesh;
}

}  // namespace medial_vk
