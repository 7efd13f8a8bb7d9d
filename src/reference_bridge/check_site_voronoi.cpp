#include "reference_bridge/check_site_voronoi.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "cpu_reference/queries.h"

namespace medial_vk {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kChords = 6000;
constexpr std::uint64_t kSeedOfChords = 20110433;
constexpr double kLeastAngleOfSites = 0x1p-12;  // twice that of points

Vector3d place_of(const Point& p) { return Vector3d(p.data()); }

/// The inside of a solid belongs to it.
std::optional<reference::Tree> solid_of_site(const VoronoiSite& site) {
  if (!site.mesh || !site.mesh->view().closed) return std::nullopt;
  const Mesh& of = site.mesh->prepared().mesh;
  reference::Mesh mesh;
  mesh.closed = true;
  mesh.vertices.reserve(of.vertices.size());
  mesh.triangles.reserve(of.triangles.size());
  for (const Point& p : of.vertices) mesh.vertices.push_back(place_of(p));
  for (const auto& [a, b, c] : of.triangles) {
    mesh.triangles.emplace_back(static_cast<int>(a), static_cast<int>(b), static_cast<int>(c));
  }
  return reference::Tree(mesh);
}

reference::Tree tree_of_site(const VoronoiSite& site) {
  reference::Mesh mesh;
  const auto add = [&](const Point& a, const Point& b, const Point& c) {
    const auto first = static_cast<int>(mesh.vertices.size());
    for (const Point& p : {a, b, c}) mesh.vertices.push_back(place_of(p));
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  };
  if (site.mesh) {
    const Mesh& of = site.mesh->prepared().mesh;
    for (const auto& [a, b, c] : of.triangles) add(of.vertices[a], of.vertices[b], of.vertices[c]);
  }
  for (const auto& [a, b, c] : site.triangles) add(a, b, c);
  for (const auto& [a, b] : site.segments) add(a, b, b);
  for (const Point& p : site.points) add(p, p, p);
  return reference::Tree(mesh);
}

class SitesCheck {
 public:
  SitesCheck(std::span<const VoronoiSite> sites, const SiteVoronoi& voronoi) : voronoi_(voronoi) {
    trees_.reserve(sites.size());
    for (const VoronoiSite& site : sites) {
      trees_.push_back(tree_of_site(site));
      if (std::optional<reference::Tree> solid = solid_of_site(site)) solids_.push_back(std::move(*solid));
      rounding_ = std::max(rounding_, trees_.back().rounding());
    }
    const double size =
        voronoi.grid.side * std::max({voronoi.grid.size[0], voronoi.grid.size[1], voronoi.grid.size[2]});
    rounding_ += 0x1p-48 * size;  // of distances from places far beyond the site
    equal_.condition = "distances of a point's sites differ by no more than its error";
    nearer_.condition = "no other site is nearer";
    sampled_.condition = "the voxel of a sample has a point, or was not decided";
    equal_.unit = nearer_.unit = "length";
  }

  CheckReport run(const std::function<void(double)>& progress) {
    const std::size_t steps = voronoi_.points.size() + kChords;
    for (std::size_t i = 0; i < voronoi_.points.size(); ++i) {
      if (i % 256 == 0) progress(static_cast<double>(i) / static_cast<double>(steps));
      test(voronoi_.points[i]);
    }
    for (const SitePoint& p : voronoi_.points) answered_.insert(p.voxel);
    answered_.insert(voronoi_.undecided.begin(), voronoi_.undecided.end());
    std::mt19937_64 random(kSeedOfChords);
    for (std::size_t i = 0; i < kChords; ++i) {
      if (i % 64 == 0) progress(static_cast<double>(voronoi_.points.size() + i) / static_cast<double>(steps));
      const Vector3d from = random_place(random);
      const Vector3d to = random_place(random);
      test_chord(from, to);
    }
    return {{equal_, nearer_, sampled_}};
  }

 private:
  static void record(CheckLine& line, double excess, double allowed, const Vector3d& at) {
    ++line.tested;
    line.worst = std::max(line.worst, excess);
    if (excess <= allowed || line.failed++ > 0) return;
    line.first_failure =
        fmt::format("{}: at ({:.9g}, {:.9g}, {:.9g}), by {:.3g}", line.condition, at[0], at[1], at[2], excess);
  }

  void test(const SitePoint& point) {
    const Vector3d at = place_of(point.point);
    double least = std::numeric_limits<double>::infinity(), greatest = 0, others = least;
    for (std::uint32_t s = 0; s < trees_.size(); ++s) {
      const double d = trees_[s].closest(at).distance;
      const auto* const end = point.sites.begin() + point.count;
      if (std::find(point.sites.begin(), end, s) == end) {
        others = std::min(others, d);
      } else {
        least = std::min(least, d);
        greatest = std::max(greatest, d);
      }
    }
    record(equal_, greatest - least, point.error + 2 * rounding_, at);
    if (trees_.size() > point.count) record(nearer_, std::max(0.0, least - others), point.error + 2 * rounding_, at);
  }

  Vector3d random_place(std::mt19937_64& random) const {
    Vector3d p;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      std::uniform_real_distribution<double> along(0, voronoi_.grid.size[axis] * voronoi_.grid.side);
      p[k] = voronoi_.grid.origin[axis] + along(random);
    }
    return p;
  }

  struct TwoNearest {
    std::size_t site = 0;
    double distance = std::numeric_limits<double>::infinity(), second_distance = distance;
    Vector3d contact = Vector3d::Zero(), second_contact = contact;
  };

  TwoNearest nearest(const Vector3d& p) const {
    TwoNearest two;
    for (std::size_t s = 0; s < trees_.size(); ++s) {
      const reference::Closest closest = trees_[s].closest(p);
      if (closest.distance < two.distance) {
        two = {s, closest.distance, two.distance, closest.point, two.contact};
      } else if (closest.distance < two.second_distance) {
        two.second_distance = closest.distance;
        two.second_contact = closest.point;
      }
    }
    return two;
  }

  void test_chord(Vector3d from, Vector3d to) {
    const std::size_t label = nearest(from).site;
    if (nearest(to).site == label) return;
    for (int i = 0; i < 60; ++i) {
      const Vector3d middle = 0.5 * (from + to);
      (nearest(middle).site == label ? from : to) = middle;
    }
    const TwoNearest two = nearest(from);
    const Vector3d a = two.contact - from, b = two.second_contact - from;
    if (0.5 * std::atan2(a.cross(b).norm(), a.dot(b)) < kLeastAngleOfSites) return;
    const auto holds_it = [&](const reference::Tree& solid) { return reference::is_inside(solid, from); };
    if (std::ranges::any_of(solids_, holds_it)) return;
    std::array<std::uint32_t, 3> voxel = {};
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = (from[static_cast<int>(k)] - voronoi_.grid.origin[k]) / voronoi_.grid.side;
      voxel[k] = static_cast<std::uint32_t>(std::clamp(std::floor(share), 0.0, voronoi_.grid.size[k] - 1.0));
    }
    record(sampled_, answered_.contains(voxel) ? 0 : 1, 0, from);
  }

  const SiteVoronoi& voronoi_;
  std::vector<reference::Tree> trees_, solids_;
  double rounding_ = 0;
  std::set<std::array<std::uint32_t, 3>> answered_;
  CheckLine equal_, nearer_, sampled_;
};

}  // namespace

CheckReport check_site_voronoi(std::span<const VoronoiSite> sites, const SiteVoronoi& voronoi,
                               const std::function<void(double)>& progress) {
  return SitesCheck(sites, voronoi).run(progress);
}

}  // namespace medial_vk
