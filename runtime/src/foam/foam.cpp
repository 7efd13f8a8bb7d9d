#include "medial_vk/foam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <new>
#include <utility>

#include "base/host_memory.h"
#include "base/point_ops.h"
#include "foam/clip_polytope.h"
#include "foam/foam_region.h"

namespace medial_vk {

namespace {

// 512 units in the last place of the largest coordinate, by which a ball of the empty foam is reduced: enough for |e|^2
// - r^2 (6 units of |e|^2) as long as r is no smaller than |e| / 64, which foam_region.cpp requires.
constexpr double kRounding = 0x1p-44;
constexpr double kClipMargin = 0x1p-40;  // ClipPolytope: of the largest coordinate, for up to 1000 cuts
constexpr double kSameSite = 0x1p-30;    // of the largest coordinate
constexpr double kOutside = 1e-6;        // of the radius
constexpr double kRoundBall = 0x1p-6;    // of the radius: accuracy of the cut of a cell to a ball
constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kDepthSteps = 256;
constexpr std::int32_t kDepthPlane = ClipPolytope::kBox + 1;

double largest_coordinate(const Point& p) { return std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}); }
bool is_finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); }

}  // namespace

class Foam::Impl {
 public:
  Impl(std::span<const FoamSample> samples, const Ball& sphere, double query_error)
      : sphere_(sphere), slack_(query_error) {
    find_scale(samples);
    for (const FoamSample& s : samples) add_sample(s);
    hull_ = hull_half_spaces(queries_, sphere.radius);
    for (std::uint32_t a = 0; a < sites_.size(); ++a) cells_.push_back(cell_of(a));
    collect_full_balls();
  }

  bool may_hold_contact(const Point& x) const {
    const auto grown = [&](const FoamBall& f) { return length(x - f.ball.centre) <= f.ball.radius + slack_; };
    const auto shrunk = [&](const Ball& b) { return length(x - b.centre) < b.radius - slack_; };
    return std::any_of(full_balls_.begin(), full_balls_.end(), grown) &&
           std::none_of(empty_balls_.begin(), empty_balls_.end(), shrunk);
  }

  double width_bound(double depth) const {
    double widest = 0;
    for (std::uint32_t a = 0; a < sites_.size(); ++a) widest = std::max(widest, site_width(a, depth, widest, kNever));
    return widest;
  }

  double depth_bound(double width) const {
    std::uint32_t bound = 0;  // in steps; holds for all sites so far
    for (std::uint32_t a = 0; a < sites_.size() && bound < kDepthSteps; ++a) {
      const auto holds = [&](std::uint32_t steps) {
        return site_width(a, steps * sphere_.radius / kDepthSteps, width, width) <= width;
      };
      if (holds(bound)) continue;
      std::uint32_t high = kDepthSteps;  // valid, as the sphere's radius bounds every depth
      while (high - bound > 1) {
        const std::uint32_t middle = (bound + high) / 2;
        (holds(middle) ? high : bound) = middle;
      }
      bound = high;
    }
    return std::max(bound * sphere_.radius / kDepthSteps, uncovered_depth());
  }

  double uncovered_depth() const {
    double nearest = sphere_.radius;
    for (const HalfSpace& h : hull_) nearest = std::min(nearest, h.offset);
    return sphere_.radius - std::max(0.0, nearest);
  }

  const Ball& sphere() const { return sphere_; }
  const std::vector<Point>& sites() const { return sites_; }
  const std::vector<Ball>& empty_balls() const { return empty_balls_; }
  const std::vector<FoamBall>& full_balls() const { return full_balls_; }
  double slack() const { return slack_; }

 private:
  Point from_centre(const Point& p) const { return p - sphere_.centre; }

  void find_scale(std::span<const FoamSample> samples) {
    double largest = largest_coordinate(sphere_.centre);
    scale_ = sphere_.radius;
    for (const FoamSample& s : samples) {
      largest = std::max({largest, largest_coordinate(s.query), largest_coordinate(s.nearest)});
      scale_ = std::max(scale_, length(from_centre(s.nearest)));
    }
    slack_ += kRounding * std::max(largest, scale_);
  }

  void add_sample(const FoamSample& s) {
    queries_.push_back(from_centre(s.query));
    empty_balls_.push_back({s.query, length(s.query - s.nearest)});
    const auto same = [&](const Point& p) { return length(p - s.nearest) <= kSameSite * scale_; };
    if (std::none_of(sites_.begin(), sites_.end(), same)) sites_.push_back(s.nearest);
  }

  /// V(A) in the hull, with coordinates relative to the sphere's centre. Names: other sites' indices for bisectors, -1
  /// - k for facet k.
  ClipPolytope cell_of(std::uint32_t site) const {
    const Point a = from_centre(sites_[site]);
    ClipPolytope cell(1.25 * sphere_.radius);
    std::vector<std::pair<double, std::uint32_t>> others;
    for (std::uint32_t b = 0; b < sites_.size(); ++b) {
      if (b != site) others.emplace_back(length(sites_[b] - sites_[site]), b);
    }
    std::sort(others.begin(), others.end());
    const double margin = kClipMargin * scale_;
    for (const auto& [distance, b] : others) {
      if (distance > 2 * cell.reach_from(a) + 4 * margin) break;  // the bisector misses the cell
      const Point normal = (1 / distance) * (sites_[b] - sites_[site]);
      const Point middle = 0.5 * (a + from_centre(sites_[b]));
      cell.clip({normal, dot(normal, middle)}, static_cast<std::int32_t>(b), margin);
    }
    for (std::size_t k = 0; k < hull_.size(); ++k) cell.clip(hull_[k], -1 - static_cast<std::int32_t>(k), margin);
    return cell;
  }

  void collect_full_balls() {
    std::map<std::array<std::int32_t, 4>, bool> seen;
    for (std::uint32_t a = 0; a < sites_.size(); ++a) {
      for (const ClipPolytope::Vertex& v : cells_[a].vertices()) {
        // The same vertex, seen from another of its sites, has the same four names.
        std::array<std::int32_t, 4> names = {static_cast<std::int32_t>(a), v.planes[0], v.planes[1], v.planes[2]};
        std::sort(names.begin(), names.end());
        if (seen.try_emplace(names, true).second) add_full_ball(v.position, a, names);
      }
    }
  }

  void add_full_ball(const Point& centre, std::uint32_t site, const std::array<std::int32_t, 4>& names) {
    FoamBall out;
    out.ball = {sphere_.centre + centre, length(centre - from_centre(sites_[site]))};
    std::size_t count = 0;
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k] >= 0 && (k == 0 || names[k] != names[k - 1]))
        out.sites[count++] = static_cast<std::uint32_t>(names[k]);
    }
    constexpr std::array kinds = {FoamBallKind::kHullVertex, FoamBallKind::kVoronoiFace, FoamBallKind::kVoronoiEdge,
                                  FoamBallKind::kVoronoiVertex};
    out.kind = kinds[count - 1];
    full_balls_.push_back(out);
  }

  /// The part of a cell at this depth or more lies in a ball around the centre. Tangent planes of the ball, each in the
  /// direction of the vertex farthest outside the ball, cut the cell nearly to that part.
  ClipPolytope part_at_depth(std::uint32_t site, double depth) const {
    ClipPolytope part = cells_[site];
    const double radius = std::max(0.0, sphere_.radius - depth);
    for (int cut = 0; cut < 200 && !part.empty(); ++cut) {
      Point furthest{};
      for (const ClipPolytope::Vertex& v : part.vertices()) {
        if (length(v.position) > length(furthest)) furthest = v.position;
      }
      const double distance = length(furthest);
      if (distance <= radius + kRoundBall * std::min(radius, depth) + 4 * kClipMargin * scale_) break;
      part.clip({(1 / distance) * furthest, radius}, kDepthPlane, kClipMargin * scale_);
    }
    return part;
  }

  /// Bound of the width of medial points in V(site) at this depth or more, refined only within [enough, too_much].
  double site_width(std::uint32_t site, double depth, double enough, double too_much) const {
    const ClipPolytope part = part_at_depth(site, depth);
    if (part.empty()) return 0;
    // A contact is no further from its medial point than the site is, and that distance is convex in the medial point.
    const Point a = from_centre(sites_[site]);
    const double plain = 2 * (part.reach_from(a) + slack_);
    if (plain <= enough) return plain;
    FoamRegion region;
    region.slack = slack_;
    for (const ClipPolytope::Vertex& v : part.vertices()) region.centres.push_back(v.position - a);
    for (const Ball& b : empty_balls_) region.empty.push_back({b.centre - sites_[site], b.radius - slack_});
    // Distances from A have an error below the slack at either end.
    return std::min(plain, width_of_region(region, enough, too_much) + 2 * slack_);
  }

  Ball sphere_;
  double slack_;
  double scale_ = 0;            // largest distance from the centre that occurs
  std::vector<Point> queries_;  // from the centre
  std::vector<Point> sites_;
  std::vector<HalfSpace> hull_;
  std::vector<ClipPolytope> cells_;  // of the sites
  std::vector<Ball> empty_balls_;
  std::vector<FoamBall> full_balls_;
};

Foam::Foam(std::unique_ptr<const Impl> impl) : impl_(std::move(impl)) {}
Foam::Foam(Foam&&) noexcept = default;
Foam& Foam::operator=(Foam&&) noexcept = default;
Foam::~Foam() = default;

Result<Foam> Foam::build(std::span<const FoamSample> samples, const Ball& sphere, double query_error) try {
  const auto usage = [](std::string message) { return Error{ErrorCode::kUsage, std::move(message)}; };
  if (samples.empty()) return usage("foam: `samples` must not be empty");
  if (!is_finite(sphere.centre) || !std::isfinite(sphere.radius) || sphere.radius <= 0)
    return usage("foam: the radius of `sphere` must be positive and all of its numbers finite");
  if (!std::isfinite(query_error) || query_error < 0)
    return usage("foam: `query_error` must be finite and not negative");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::string name = "foam: sample " + std::to_string(i);
    if (!is_finite(samples[i].query) || !is_finite(samples[i].nearest))
      return usage(name + " has a coordinate that is not finite");
    if (length(samples[i].query - sphere.centre) > (1 + kOutside) * sphere.radius)
      return usage(name + " lies outside the sphere");
  }
  return Foam(std::make_unique<const Impl>(samples, sphere, query_error));
} catch (const std::bad_alloc&) {
  return out_of_memory("building a foam");
}

const Ball& Foam::sphere() const { return impl_->sphere(); }
const std::vector<Point>& Foam::sites() const { return impl_->sites(); }
const std::vector<Ball>& Foam::empty_balls() const { return impl_->empty_balls(); }
const std::vector<FoamBall>& Foam::full_balls() const { return impl_->full_balls(); }
double Foam::slack() const { return impl_->slack(); }
bool Foam::may_hold_contact(const Point& x) const { return impl_->may_hold_contact(x); }
double Foam::width_bound(double depth) const { return impl_->width_bound(depth); }
double Foam::depth_bound(double width) const { return impl_->depth_bound(width); }
double Foam::uncovered_depth() const { return impl_->uncovered_depth(); }

}  // namespace medial_vk
