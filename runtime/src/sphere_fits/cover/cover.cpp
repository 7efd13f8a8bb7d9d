#include "sphere_fits/cover/cover.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "base/point_ops.h"
#include "sphere_fits/cover/smallest_ball.h"
#include "sphere_fits/quality/sphere_certificate.h"
#include "sphere_fits/quality/surface_samples.h"

namespace medial_vk {
namespace {

/// With up to this number of balls a second start is worth its time, since the result depends strongly on the start.
constexpr std::size_t kFew = 64;
/// With more than this number the search is short.
constexpr std::size_t kMany = 256;
/// The least growth of radii before the proof, as a share of the diagonal.
constexpr double kRoom = 1e-9;
/// What probes count for, compared with the area of the boundary.
constexpr double kProbesCount = 8;

/// Number of elements of the boundary: enough that an element reaches only negligibly out of a ball that holds its
/// middle.
std::size_t elements_for(std::size_t balls) {
  if (balls <= 16) return 6'000;
  return balls <= kFew ? 10'000 : std::min<std::size_t>(6'000 + 4 * balls, 60'000);
}

CoverSearch search_for(const Solid& solid, std::vector<Ball> balls, std::span<const Probe> probes,
                       const Threads& threads) {
  CoverElements elements(solid, elements_for(balls.size()), threads);
  if (!probes.empty()) elements.add(probes, kProbesCount * elements.whole_area());
  return {std::move(elements), std::move(balls), 0.1 * solid.diagonal(), threads};
}

/// A start without the balls inside: points far from each other, then moved to the middles of the points nearest to
/// them.
std::vector<Ball> spread_over(const std::vector<Point>& points, std::size_t count) {
  constexpr int kRounds = 6;
  std::vector<Point> centres = {points.front()};
  std::vector<double> away(points.size(), std::numeric_limits<double>::infinity());
  while (centres.size() < count) {
    std::size_t farthest = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      away[i] = std::min(away[i], length(points[i] - centres.back()));
      if (away[i] > away[farthest]) farthest = i;
    }
    centres.push_back(points[farthest]);
  }
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Point> sum(centres.size());
    std::vector<double> number(centres.size());
    for (const Point& p : points) {
      std::size_t nearest = 0;
      for (std::size_t k = 1; k < centres.size(); ++k) {
        if (length(p - centres[k]) < length(p - centres[nearest])) nearest = k;
      }
      sum[nearest] = sum[nearest] + p;
      ++number[nearest];
    }
    for (std::size_t k = 0; k < centres.size(); ++k) {
      if (number[k] > 0) centres[k] = (1 / number[k]) * sum[k];
    }
  }
  std::vector<Ball> balls;
  balls.reserve(centres.size());
  for (const Point& centre : centres) balls.push_back({centre, 0});
  return balls;
}

}  // namespace

Cover::Cover(const Solid& solid, std::vector<Ball> balls, unsigned threads, const Report& report,
             std::span<const Probe> probes)
    : solid_(solid),
      threads_(threads,
               [report] {
                 report(0);
                 return true;
               }),
      report_(report),
      search_(search_for(solid, std::move(balls), probes, threads_)),
      has_probes_(!probes.empty()) {}

void Cover::search(double from, double until) {
  constexpr int kRounds = 24, kRoundsOfMany = 2;
  keep();
  improve(is_many() ? kRoundsOfMany : kRounds, from, until);
}

void Cover::polish() {
  constexpr int kRounds = 4, kRoundsOfMany = 1;
  for (int round = 0; round < 2; ++round) {
    search_.refine();
    improve(is_many() ? kRoundsOfMany : kRounds, 0.8 + 0.07 * round, 0.87 + 0.07 * round);
  }
  improved_ = count();
}

void Cover::shrink() {
  constexpr std::size_t kPeriod = 8;  // all are improved when an eighth has been removed
  search_.remove_one();
  search_.slide();
  keep();
  if (count() + std::max<std::size_t>(1, improved_ / kPeriod) > improved_) return;
  improved_ = count();
  improve(3, 0.94, 0.95);
}

/// Many balls begin so close to what they can become that further rounds gain less than a hundredth of what is added,
/// in twice the time; by probes they move farther.
bool Cover::is_many() const { return count() > kMany && !has_probes_; }

double Cover::measure() const {
  if (has_probes_) return search_.total();
  const Result<BallUnion> measured = measure_ball_union(search_.balls(), {threads_.count, false});
  if (!measured) throw std::bad_alloc();  // The balls are finite, so the error is one of memory.
  return measured.value().volume;
}

void Cover::keep() {
  volume_ = measure();
  best_ = search_.balls();
}

/// Repeats steps until two gain less than a thousandth of the volume, or a hundredth of the sum of columns, which is a
/// small part of that volume; keeps the best set of balls.
void Cover::improve(int rounds, double from, double until) {
  const double least_gain = has_probes_ ? 1e-2 : 1e-3;
  constexpr int kPatience = 2;
  int idle = 0;
  for (int round = 0; round < rounds && idle < kPatience; ++round) {
    report_(from + (until - from) * round / rounds);
    search_.relocate();
    search_.trade();
    search_.slide();
    const double now = measure();
    idle = now < volume_ * (1 - least_gain) ? 0 : idle + 1;
    if (now < volume_) {
      volume_ = now;
      best_ = search_.balls();
    }
  }
  search_.restore(best_);
}

std::vector<Ball> Cover::enlarged(double by) const {
  std::vector<Ball> balls;
  for (const Ball& ball : search_.balls()) {
    if (ball.radius > 0) balls.push_back({ball.centre, ball.radius + by});
  }
  return balls;
}

/// Vertices of the envelope in the solid border on cavities: a ball must hold those, too.
/// Balls only grow, and so does their union: CoverFamily relies on it.
bool Cover::fill(const Envelope& envelope) {
  std::vector<Point> inside;
  for (const EnvelopeVertex& vertex : envelope.vertices()) {
    if (solid_.contains(vertex.at)) inside.push_back(vertex.at);
  }
  if (inside.empty()) return false;
  search_.add(inside);
  return true;
}

std::vector<Ball> Cover::certified() const {
  constexpr int kFillings = 12;
  Cover filled = *this;  // The filling is no part of the search, which may continue.
  double by = kRoom * solid_.diagonal();
  std::uint64_t least_inside = std::numeric_limits<std::uint64_t>::max();
  for (int attempt = 0;; ++attempt) {
    report_(0.95 + 0.05 * std::min(1.0, attempt / 60.0));
    std::vector<Ball> balls = filled.enlarged(by);
    const Result<Envelope> envelope = Envelope::build(balls, threads_.count);
    if (!envelope) throw std::bad_alloc();
    const Result<CoverProof> proof = prove_cover(solid_, envelope.value(), threads_);
    if (!proof && proof.error().code == ErrorCode::kInterrupted) throw Stopped();
    if (!proof) throw std::bad_alloc();
    const CoverProof& found = proof.value();
    if (found.surface_proved()) {
      if (found.inside == 0) return balls;
      const bool is_fewer = found.inside < least_inside;
      least_inside = std::min(least_inside, found.inside);
      if (attempt < kFillings && (found.closed || is_fewer) && filled.fill(envelope.value())) continue;
      // Near a hole the winding number passes 1/2 without a surface: balls would have to grow far beyond the mesh
      // before no vertex counts as inside, and nothing more would be proved.
      if (!found.closed) return balls;
    }
    by *= 2;  // Once this is the diagonal every ball holds everything.
  }
}

Cover search_cover(const Solid& solid, std::vector<Ball> inside, unsigned threads, const Cover::Report& report,
                   std::span<const Probe> probes) {
  constexpr std::size_t kStartPoints = 4000;
  const std::size_t count = inside.size();
  Cover best(solid, std::move(inside), threads, report, probes);
  best.search(0, count <= kFew ? 0.4 : 0.8);
  if (count <= kFew) {
    Cover other(solid, spread_over(sample_surface(solid.mesh().mesh, kStartPoints), count), threads, report, probes);
    other.search(0.4, 0.8);
    if (other.volume() < best.volume()) {
      other.polish();
      return other;
    }
  }
  best.polish();
  return best;
}

Ball ball_around(const Solid& solid) {
  Ball ball = smallest_ball(solid.mesh().mesh.vertices);
  ball.radius += kRoom * solid.diagonal();
  return ball;
}

}  // namespace medial_vk
