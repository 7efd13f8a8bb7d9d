#include "sphere_fits/spread/reach_cover.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/format_text.h"
#include "base/point_ops.h"
#include "sphere_fits/quality/envelope.h"
#include "sphere_fits/quality/nearest_ball_tree.h"
#include "sphere_fits/quality/sphere_certificate.h"
#include "sphere_fits/quality/surface_samples.h"
#include "sphere_fits/spread/spread_search.h"

namespace medial_vk {
namespace {

/// Places: so many on a square whose side is the reach, and at least and at most.
constexpr double kPlacesOfReach = 64;
constexpr std::size_t kLeastPlaces = 8192, kMostPlaces = 1 << 18;
constexpr int kRounds = 16;
constexpr int kFillings = 64;  // of gaps that proofs find
constexpr double kTightenings = 512;
/// Of the balls of a first set, so few times fewer are tried.
constexpr std::size_t kMostTimesFewer = 4;
/// Up to so many balls are found soon, even if fewer are wanted, so that their number can be named.
constexpr std::size_t kSoon = 1024;

double area_of(const Mesh& mesh) {
  double area = 0;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    area += 0.5 * length(cross(b - a, c - a));
  }
  return area;
}

std::size_t places_for(const Solid& solid, double reach) {
  const double wanted = kPlacesOfReach * area_of(solid.mesh().mesh) / (reach * reach);
  return static_cast<std::size_t>(
      std::clamp(wanted, static_cast<double>(kLeastPlaces), static_cast<double>(kMostPlaces)));
}

class ReachSearch {
 public:
  ReachSearch(const Solid& solid, double reach, bool for_cover, std::size_t wanted, std::size_t most,
              const Threads& threads, const std::function<void(double)>& report)
      : solid_(solid),
        reach_(reach),
        // The balls of the search lie within the boundary by the rounding; grown ones must hold the places for any.
        gap_(reach - 4 * solid.rounding()),
        wanted_(wanted),
        most_(wanted == 0 ? most : std::max(wanted, std::min(most, std::max(kSoon, 2 * kMostTimesFewer * wanted)))),
        threads_(threads),
        report_(report),
        places_(places_for(solid, reach)),
        search_(solid, places_of(solid, places_), threads, for_cover) {}

  Result<std::vector<Ball>> run() {
    if (!fill()) return too_many();
    if (const std::size_t size = search_.balls().size();
        wanted_ > 0 && size > kSoon && size / kMostTimesFewer > wanted_)
      return Error{ErrorCode::kUsage, format_text("no {} balls are found: a first set has {}", wanted_, size)};
    find_fewer();
    if (!fill_between_places()) return too_many();
    for (int filling = 0; filling < kFillings; ++filling) {
      show(0.8 + 0.2 * filling / kFillings);
      const std::vector<Ball> grown = grown_balls(solid_, search_.balls(), reach_);
      const Result<Envelope> envelope = Envelope::build(grown, threads_.count);
      if (!envelope) return envelope.error();
      const Result<CoverProof> proof = prove_cover(solid_, envelope.value(), threads_);
      if (!proof) return proof.error();
      const CoverProof& found = proof.value();
      if (found.surface_proved() && (found.inside == 0 || !found.closed)) return search_.balls();
      add_places(found, envelope.value());
      // Where a place is just held, points next to it are not.
      gap_ -= reach_ / kTightenings;
      if (!settle()) return too_many();
    }
    return Error{ErrorCode::kUsage, "no set is found for which this distance can be proved"};
  }

 private:
  void show(double done) const {
    if (report_) report_(done);
  }

  Error too_many() const {
    const std::size_t size = search_.balls().size();
    return {ErrorCode::kUsage, format_text("even {} {} a part at a distance of {:.3g}", size,
                                           size == 1 ? "ball leaves" : "balls leave", search_.gap())};
  }

  /// Adds balls until no place is too far.
  bool fill() {
    while (search_.gap() > gap_) {
      if (search_.balls().size() >= most_ || !search_.insert()) return false;
      show(0.2 * std::min(1.0, gap_ / search_.gap()));
    }
    return true;
  }

  bool settle() {
    if (search_.gap() > gap_) search_.improve(kRounds);
    return fill();
  }

  /// Of fewer than those of fill(), moved, some suffice: the number is bisected, as if more never failed.
  void find_fewer() {
    const std::vector<Ball> order = search_.balls();
    std::vector<Ball> best = order;
    std::size_t too_few = order.size() / kMostTimesFewer;
    int steps = 0;
    while (best.size() - too_few > std::max<std::size_t>(1, best.size() / 64)) {
      show(0.2 + 0.6 * (1 - 1.0 / ++steps));
      const std::size_t count = too_few + (best.size() - too_few) / 2;
      search_.restore({order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count)});
      search_.improve(kRounds);
      if (search_.gap() <= gap_) {
        best = search_.balls();
      } else {
        too_few = count;
      }
    }
    search_.restore(std::move(best));
  }

  /// Where the proof failed: on the boundary, and the vertices of the envelope in the solid, which border on cavities.
  void add_places(const CoverProof& proof, const Envelope& envelope) {
    if (!proof.surface_proved()) search_.add_place({proof.first_uncovered, {}});
    for (const EnvelopeVertex& vertex : envelope.vertices()) {
      if (solid_.contains(vertex.at)) search_.add_place({vertex.at, {}});
    }
  }

  /// Other points of the boundary, more of them: those too far become places, too.
  bool fill_between_places() {
    constexpr int kTries = 8;
    const std::vector<Point> points = sample_surface(solid_.mesh().mesh, 4 * places_);
    for (int tries = 0; tries < kTries; ++tries) {
      const NearestBallTree tree(search_.balls());
      std::vector<std::uint8_t> is_far(points.size());
      for_all(points.size(), 256, threads_,
              [&](std::size_t i) { is_far[i] = tree.nearest(points[i]).distance > gap_ ? 1 : 0; });
      if (std::ranges::find(is_far, 1) == is_far.end()) break;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_far[i] != 0) search_.add_place({points[i], {}});
      }
      if (!settle()) return false;
    }
    return true;
  }

  const Solid& solid_;
  const double reach_;
  double gap_;  // that the search is to reach
  const std::size_t wanted_, most_;
  const Threads& threads_;
  const std::function<void(double)>& report_;
  const std::size_t places_;
  SpreadSearch search_;
};

}  // namespace

Result<std::vector<Ball>> spread_within(const Solid& solid, double reach, bool for_cover, std::size_t wanted,
                                        std::size_t most, const Threads& threads,
                                        const std::function<void(double)>& report) {
  return ReachSearch(solid, reach, for_cover, wanted, most, threads, report).run();
}

std::vector<Ball> grown_balls(const Solid& solid, const std::vector<Ball>& inside, double reach) {
  std::vector<Ball> balls;
  balls.reserve(inside.size());
  for (const Ball& ball : inside) {
    balls.push_back({ball.centre, solid.distance(ball.centre) + reach - 2 * solid.rounding()});
  }
  return balls;
}

}  // namespace medial_vk
