#include "hull_fits/search/hull_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::size_t kGeneration = 4;
constexpr double kFirstStep = 0.5, kLeastStep = 0.01, kMostStep = 1;
/// Of the diagonal of the box: thinner hulls cover nothing that matters, and radii must not vanish, since the axis of a
/// hull would otherwise pass through the boundary unseen.
constexpr double kLeastRadius = 1e-4;
/// Of the diagonal, by which triangles may be in hulls until they are made free in the end.
constexpr double kTolerance = 1e-8;

}  // namespace

HullSearch::HullSearch(const Solid& solid, std::span<const Ball> medial, const HullShape& shape,
                       const HullSearchEffort& effort, const Threads& threads)
    : solid_(solid),
      effort_(effort),
      threads_(threads),
      pool_(threads.count),
      radii_(solid, kLeastRadius * solid.diagonal(), kTolerance * solid.diagonal()),
      seeds_(medial),
      moves_(solid, radii_, seeds_, shape),
      lines_(solid.mesh().report.lower, solid.mesh().report.upper, effort.lines) {}

/// The best new hulls, in the order of their gains.
std::vector<HullSearch::Trial> HullSearch::propose(std::size_t except) {
  std::vector<Trial> trials(effort_.proposals);
  const std::uint64_t first = draws_;
  draws_ += trials.size();
  pool_.run(trials.size(), 1, [&](std::size_t i) {
    threads_.check();
    SplitMix random(0x9e3779b97f4a7c15ull * (first + i + 1));
    const std::optional<BallHull> hull = moves_.propose(random);
    if (hull) trials[i] = {*hull, lines_.gain(*hull, except)};
  });
  std::stable_sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) { return a.gain > b.gain; });
  trials.resize(std::min(trials.size(), effort_.climbed));
  return trials;
}

/// Steps grow with success and shrink without, so that about every fifth succeeds (I. Rechenberg, 1973).
void HullSearch::climb(Trial& trial, double& step, std::size_t generations, std::size_t except) {
  for (std::size_t generation = 0; generation < generations; ++generation) {
    std::array<Trial, kGeneration> next;
    const std::uint64_t first = draws_;
    draws_ += kGeneration;
    pool_.run(kGeneration, 1, [&](std::size_t i) {
      threads_.check();
      SplitMix random(0x9e3779b97f4a7c15ull * (first + i + 1));
      const auto is_promising = [&](const BallHull& bound) { return lines_.gain(bound, except) > trial.gain; };
      const std::optional<BallHull> hull = moves_.change(trial.hull, step, random, is_promising);
      if (hull) next[i] = {*hull, lines_.gain(*hull, except)};
    });
    const Trial& best =
        *std::max_element(next.begin(), next.end(), [](const Trial& a, const Trial& b) { return a.gain < b.gain; });
    const bool succeeds = best.gain > trial.gain;
    if (succeeds) trial = best;
    step = std::clamp(step * (succeeds ? 1.4 : 0.75), kLeastStep, kMostStep);
  }
}

HullSearch::Trial HullSearch::best_new(std::size_t except) {
  Trial best;
  for (Trial& trial : propose(except)) {
    if (!(trial.gain > 0)) continue;
    double step = kFirstStep;
    climb(trial, step, effort_.climb, except);
    if (trial.gain > best.gain) best = trial;
  }
  return best;
}

bool HullSearch::grow() {
  if (!seeds_.any()) return false;
  const Trial best = best_new(CoverageLines::kNone);
  if (!(best.gain > 0)) return false;
  lines_.add(best.hull);
  seeds_.add(best.hull);
  seeds_.update();
  steps_.push_back(0.1);
  return true;
}

void HullSearch::replace(std::size_t i, const Trial& trial) {
  seeds_.remove(lines_.hull(i));
  seeds_.add(trial.hull);
  seeds_.update();
  lines_.replace(i, trial.hull);
}

void HullSearch::improve() {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    Trial trial = {lines_.hull(i), lines_.gain(lines_.hull(i), i)};
    const double before = trial.gain;
    climb(trial, steps_[i], effort_.polish, i);
    if (trial.gain > before) replace(i, trial);
    order.emplace_back(trial.gain, i);
  }
  std::sort(order.begin(), order.end());
  const std::size_t exchanged = (lines_.size() + 9) / 10;
  for (std::size_t k = 0; k < exchanged && seeds_.any(); ++k) {
    const std::size_t i = order[k].second;
    const Trial best = best_new(i);
    if (!(best.gain > lines_.gain(lines_.hull(i), i))) continue;
    replace(i, best);
    steps_[i] = 0.1;
  }
}

}  // namespace medial_vk
