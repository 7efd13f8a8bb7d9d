#include "plane/sites/site_set.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace medial_vk::plane {

SiteSet::SiteSet(std::vector<Vec2> points, std::span<const Edge> edges, std::span<const std::uint32_t> owners_of_points,
                 std::span<const std::uint32_t> owners_of_edges)
    : points_(std::move(points)), owners_of_points_(owners_of_points.begin(), owners_of_points.end()) {
  add_segments(edges, owners_of_edges);
  build_fans();
  if (!owners_of_points_.empty()) return;
  owners_of_points_.assign(points_.size(), 0);
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    if (!segments_of(p).empty()) owners_of_points_[p] = segment(segments_of(p).front()).owner;
  }
}

void SiteSet::add_segments(std::span<const Edge> edges, std::span<const std::uint32_t> owners) {
  segments_.reserve(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Vec2 a = points_[edges[i][0]], b = points_[edges[i][1]];
    Segment s;
    s.begin = a;
    s.length = plane::distance(a, b);
    s.along = (1 / s.length) * (b - a);
    s.ends = edges[i];
    s.owner = owners.empty() ? 0 : owners[i];
    segments_.push_back(s);
  }
}

void SiteSet::build_fans() {
  first_of_fan_.assign(points_.size() + 1, 0);
  for (const Segment& s : segments_) {
    for (const std::uint32_t end : s.ends) ++first_of_fan_[end + 1];
  }
  for (std::size_t p = 0; p < points_.size(); ++p) first_of_fan_[p + 1] += first_of_fan_[p];
  fans_.resize(2 * segments_.size());
  std::vector<std::uint32_t> next(first_of_fan_.begin(), first_of_fan_.end() - 1);
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    for (const std::uint32_t end : segments_[i].ends) {
      fans_[next[end]++] = static_cast<std::uint32_t>(points_.size() + i);
    }
  }
  for (std::uint32_t p = 0; p < points_.size(); ++p) {
    const auto direction = [&](std::uint32_t site) {
      const Vec2 u = leaving(p, site);
      return std::atan2(u.y, u.x);
    };
    if (segments_of(p).size() < 3) continue;  // either order is angular
    std::sort(
        fans_.begin() + first_of_fan_[p], fans_.begin() + first_of_fan_[p + 1],
        [&](std::uint32_t a, std::uint32_t b) { return std::pair(direction(a), a) < std::pair(direction(b), b); });
  }
}

Vec2 SiteSet::foot(std::uint32_t site, Vec2 x) const {
  if (is_point(site)) return points_[site];
  const Segment& s = segment(site);
  return s.begin + std::clamp(s.position(x), 0.0, s.length) * s.along;
}

double SiteSet::outside_of_region(std::uint32_t site, Vec2 x) const {
  if (!is_point(site)) {
    const Segment& s = segment(site);
    const double position = s.position(x);
    return std::max(-position, position - s.length);
  }
  double most = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t s : segments_of(site)) most = std::max(most, dot(leaving(site, s), x - points_[site]));
  return most;
}

Side SiteSet::side_of(std::uint32_t site, Vec2 x) const {
  if (!is_point(site)) {
    const Segment& s = segment(site);
    const double position = s.position(x);
    if (position >= 0 && position <= s.length) return s.height(x, Side::kLeft) >= 0 ? Side::kLeft : Side::kRight;
    site = s.ends[position < 0 ? 0 : 1];
  }
  Side side = Side::kLeft;
  double greatest = -std::numeric_limits<double>::infinity();
  for (const std::uint32_t s : segments_of(site)) {
    const double cosine = dot(leaving(site, s), x - points_[site]);
    if (cosine <= greatest) continue;
    greatest = cosine;
    side = segment(s).height(x, Side::kLeft) >= 0 ? Side::kLeft : Side::kRight;
  }
  return side;
}

}  // namespace medial_vk::plane
