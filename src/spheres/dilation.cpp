#include "spheres/dilation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>
#include <string>
#include <utility>

#include "mesh/point_ops.h"
#include "spheres/cover_search.h"
#include "spheres/smallest_ball.h"
#include "spheres/surface_samples.h"

namespace medial_vk {
namespace {

/// Thrown where progress says stop.
struct Interrupted {};

/// With so few balls where they start decides more than what it costs to start twice, from finer pieces.
constexpr std::size_t kFew = 64;

/// Of the boundary: enough that what a piece sticks out of a ball does not count.
std::size_t pieces_for(std::size_t balls) {
  return balls <= kFew ? 16'000 : std::min<std::size_t>(6'000 + 4 * balls, 60'000);
}

CoverSearch search_for(const Solid& solid, std::vector<Ball> balls, unsigned threads) {
  CoverPieces pieces(solid, pieces_for(balls.size()), threads);
  return {std::move(pieces), std::move(balls), 0.1 * solid.diagonal(), threads};
}

class Cover {
 public:
  Cover(const Solid& solid, std::vector<Ball> balls, unsigned threads, const SphereProgress& progress)
      : solid_(solid), threads_(threads), progress_(progress), search_(search_for(solid, std::move(balls), threads)) {}

  /// Of the union, as far as the search has come.
  double search(double from, double until) {
    keep();
    improve(24, from, until);
    return volume_;
  }

  std::vector<Ball> finish() {
    for (int round = 0; round < 2; ++round) {
      search_.refine();
      improve(4, 0.8 + 0.07 * round, 0.87 + 0.07 * round);
    }
    return certified();
  }

 private:
  void report(double done) const {
    if (progress_ && !progress_("cover", done)) throw Interrupted{};
  }

  /// Of the union, exactly.
  double volume() const {
    const Result<BallUnion> measured = measure_ball_union(search_.balls(), {threads_, false});
    if (!measured) throw std::bad_alloc();  // The balls are finite, so memory it is.
    return measured.value().volume;
  }

  void keep() {
    volume_ = volume();
    best_ = search_.balls();
  }

  /// Steps until two gain less than a thousandth of the volume; the best set of balls is kept.
  void improve(int rounds, double from, double until) {
    constexpr double kGain = 1e-3;
    constexpr int kPatience = 2;
    int idle = 0;
    for (int round = 0; round < rounds && idle < kPatience; ++round) {
      report(from + (until - from) * round / rounds);
      search_.relocate();
      search_.trade();
      search_.slide();
      const double now = volume();
      idle = now < volume_ * (1 - kGain) ? 0 : idle + 1;
      if (now < volume_) keep();
    }
    search_.restore(best_);
  }

  std::vector<Ball> enlarged(double by) const {
    std::vector<Ball> balls;
    for (const Ball& ball : search_.balls()) {
      if (ball.radius > 0) balls.push_back({ball.centre, ball.radius + by});
    }
    return balls;
  }

  /// Vertices of the envelope in the solid border on cavities: a ball must hold those, too.
  bool fill(const Envelope& envelope) {
    std::vector<Point> inside;
    for (const EnvelopeVertex& vertex : envelope.vertices()) {
      if (solid_.contains(vertex.at)) inside.push_back(vertex.at);
    }
    for (const Point& p : inside) search_.add({&p, 1});
    if (inside.empty()) return false;
    search_.slide();
    return true;
  }

  /// The proof decides. What it finds open is filled; at last all balls grow until it finds nothing.
  std::vector<Ball> certified() {
    constexpr int kFillings = 12;
    const double diagonal = solid_.diagonal();
    double by = 1e-9 * diagonal;
    for (int attempt = 0;; ++attempt) {
      report(0.95 + 0.05 * std::min(1.0, attempt / 60.0));
      std::vector<Ball> balls = enlarged(by);
      const Result<Envelope> envelope = Envelope::build(balls, threads_);
      if (!envelope) throw std::bad_alloc();
      const Result<CoverProof> proof = prove_cover(solid_, envelope.value(), threads_);
      if (!proof) throw std::bad_alloc();
      if (proof.value().surface_proved() && proof.value().inside == 0) return balls;
      if (proof.value().surface_proved() && attempt < kFillings && fill(envelope.value())) continue;
      by *= 2;  // Once this is the diagonal every ball holds everything.
    }
  }

  const Solid& solid_;
  unsigned threads_;
  const SphereProgress& progress_;
  CoverSearch search_;
  std::vector<Ball> best_;
  double volume_ = 0;
};

Status check(const std::vector<Ball>& balls) {
  if (balls.empty()) return Error{ErrorCode::kUsage, "no balls to cover the solid with"};
  for (std::size_t i = 0; i < balls.size(); ++i) {
    bool is_finite = std::isfinite(balls[i].radius) && balls[i].radius >= 0;
    for (const double x : balls[i].centre) is_finite = is_finite && std::isfinite(x);
    if (!is_finite) {
      return Error{ErrorCode::kUsage, "ball " + std::to_string(i) + " has a centre or radius that is no number"};
    }
  }
  return {};
}

/// Points far from each other, then in the middles of what is nearest to them: a start that asks nothing of the balls
/// inside.
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

/// The better of two, where balls are few.
std::vector<Ball> cover_from_starts(const Solid& solid, std::vector<Ball> inside, unsigned threads,
                                    const SphereProgress& progress) {
  constexpr std::size_t kStartPoints = 4000;
  const std::size_t count = inside.size();
  Cover first(solid, std::move(inside), threads, progress);
  const double volume = first.search(0, count <= kFew ? 0.4 : 0.8);
  if (count > kFew) return first.finish();
  Cover second(solid, spread_over(sample_surface(solid.mesh().mesh, kStartPoints), count), threads, progress);
  return second.search(0.4, 0.8) < volume ? second.finish() : first.finish();
}

/// The smallest ball that holds all vertices, and a little more.
Ball around_everything(const Solid& solid) {
  Ball ball = smallest_ball(solid.mesh().mesh.vertices);
  ball.radius += 1e-9 * solid.diagonal();
  return ball;
}

}  // namespace

Result<SphereSet> cover_solid(const Solid& solid, SphereSet inside, unsigned threads, const SphereProgress& progress) {
  if (Status status = check(inside.balls); !status.ok()) return status.error();
  try {
    SphereSet cover = {cover_from_starts(solid, std::move(inside.balls), threads, progress)};
    const Ball one = around_everything(solid);
    const Result<BallUnion> measured = measure_ball_union(cover.balls, {threads, false});
    if (!measured) return measured.error();
    const bool is_smaller = 4 * std::numbers::pi / 3 * one.radius * one.radius * one.radius < measured.value().volume;
    return is_smaller ? SphereSet{{one}} : cover;
  } catch (const Interrupted&) {
    return Error{ErrorCode::kInterrupted, "interrupted"};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "not enough memory to cover the solid"};
  }
}

}  // namespace medial_vk
