#include "set_cover.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "samples.h"
#include "sphere_fits/quality/surface_samples.h"
#include "voronoi_vertices.h"

namespace medial_vk::bench {
namespace {

constexpr std::size_t kSamplesOfBall = 20, kLeastToCover = 1500;
constexpr std::size_t kSitesOfBall = 40, kLeastSites = 10'000;  // of the boundary, for candidates
/// Halvings of the interval between an offset that suffices and one of half of it, on a logarithmic scale: 2^(1/32).
constexpr int kHalvings = 5;
/// The search ends here, where a smaller offset changes nothing.
constexpr double kLeastOffset = 1e-6;

/// The choice among candidates with one offset.
class GreedyChoice {
 public:
  GreedyChoice(const std::vector<Ball>& candidates, const std::vector<Point>& samples, double offset, unsigned threads)
      : candidates_(candidates),
        covered_by_(candidates.size()),
        covering_(samples.size()),
        counts_(candidates.size()),
        distances_(candidates.size(), std::numeric_limits<double>::infinity()),
        is_chosen_(candidates.size(), 0),
        is_covered_(samples.size(), 0),
        uncovered_(samples.size()) {
    parallel_for(candidates.size(), 64, threads, [&](std::size_t i) {
      const double reach = candidates[i].radius + offset;
      for (std::size_t s = 0; s < samples.size(); ++s) {
        const Point d = samples[s] - candidates[i].centre;
        if (dot(d, d) <= reach * reach) covered_by_[i].push_back(static_cast<std::uint32_t>(s));
      }
    });
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      counts_[i] = static_cast<double>(covered_by_[i].size());
      for (const std::uint32_t s : covered_by_[i]) covering_[s].push_back(static_cast<std::uint32_t>(i));
    }
  }

  std::size_t uncovered() const { return uncovered_; }

  /// Up to `count` candidates in the order of choice; with `ends`, only until all samples are covered.
  std::vector<Ball> choose(std::size_t count, double uniformity, bool ends) {
    std::vector<Ball> chosen;
    while (chosen.size() < std::min(count, candidates_.size()) && (!ends || uncovered_ > 0)) {
      const Scale coverage = scale_of(counts_), distance = scale_of(distances_);
      std::size_t best = candidates_.size();
      double best_score = -std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < candidates_.size(); ++i) {
        if (is_chosen_[i] != 0) continue;
        const double apart = chosen.empty() ? 0 : uniformity * distance.of(distances_[i]);
        const double score = coverage.of(counts_[i]) + apart;
        if (score > best_score) best = i, best_score = score;
      }
      take(best);
      chosen.push_back(candidates_[best]);
    }
    return chosen;
  }

 private:
  struct Scale {
    double mean, deviation;
    double of(double value) const { return deviation > 0 ? (value - mean) / deviation : 0; }
  };

  /// Of the candidates that are left.
  Scale scale_of(const std::vector<double>& values) const {
    CompensatedSum sum, squares;
    double number = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (is_chosen_[i] != 0) continue;
      sum.add(values[i]);
      ++number;
    }
    const double mean = sum.value() / number;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (is_chosen_[i] == 0) squares.add((values[i] - mean) * (values[i] - mean));
    }
    return {mean, std::sqrt(squares.value() / number)};
  }

  void take(std::size_t i) {
    is_chosen_[i] = 1;
    for (const std::uint32_t s : covered_by_[i]) {
      if (is_covered_[s] != 0) continue;
      is_covered_[s] = 1;
      --uncovered_;
      for (const std::uint32_t other : covering_[s]) --counts_[other];
    }
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      distances_[k] = std::min(distances_[k], length(candidates_[k].centre - candidates_[i].centre));
    }
  }

  const std::vector<Ball>& candidates_;
  std::vector<std::vector<std::uint32_t>> covered_by_;  // samples, by candidate
  std::vector<std::vector<std::uint32_t>> covering_;    // candidates, by sample
  std::vector<double> counts_;                          // of uncovered samples, by candidate
  std::vector<double> distances_;                       // from the nearest chosen one
  std::vector<std::uint8_t> is_chosen_, is_covered_;
  std::size_t uncovered_;
};

/// The Voronoi vertices inside, as the largest balls there.
std::vector<Ball> candidates_of(const Solid& solid, const SetCoverOptions& options) {
  const std::size_t points =
      options.candidates > 0 ? options.candidates : std::max(kLeastSites, kSitesOfBall * options.count);
  const std::vector<Point> boundary = sample_surface(solid.mesh().mesh, points);
  std::vector<Point> centres;
  for (const VoronoiVertex& vertex : voronoi_vertices(boundary, options.threads)) centres.push_back(vertex.at);
  return largest_inside(solid, centres, options.threads);
}

}  // namespace

std::vector<Ball> greedy_set_cover(const Solid& solid, const SetCoverOptions& options) {
  const std::vector<Ball> candidates = candidates_of(solid, options);
  if (candidates.empty() || options.count == 0) return {};
  const std::size_t number =
      options.samples > 0 ? options.samples : std::max(kLeastToCover, kSamplesOfBall * options.count);
  const std::vector<Point> samples = sample_surface(solid.mesh().mesh, number);
  const double side = solid.mesh().report.longest_side();
  const auto suffices = [&](double offset) {
    GreedyChoice choice(candidates, samples, offset * side, options.threads);
    choice.choose(options.count, options.uniformity, true);
    return choice.uncovered() == 0;
  };
  double offset = options.offset;
  if (options.fits_offset) {
    while (!suffices(offset)) offset *= 2;
    while (offset > kLeastOffset && suffices(0.5 * offset)) offset *= 0.5;
    double too_small = 0.5 * offset;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = std::sqrt(too_small * offset);
      (suffices(middle) ? offset : too_small) = middle;
    }
  }
  return GreedyChoice(candidates, samples, offset * side, options.threads)
      .choose(options.count, options.uniformity, false);
}

}  // namespace medial_vk::bench
