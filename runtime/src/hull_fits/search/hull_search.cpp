#include "hull_fits/search/hull_search.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"
#include "sphere_fits/quality/surface_samples.h"
#include "sphere_fits/steps/maximal_ball.h"

namespace medial_vk {
namespace {

constexpr std::size_t kGeneration = 4;
constexpr double kFirstStep = 0.5, kPolishStep = 0.1, kLeastStep = 0.01, kMostStep = 1;
/// Of the diagonal of the box, and of the radius that a tenth of the medial balls do not reach: thinner hulls cover
/// nothing that matters, and radii must not vanish, since the axis of a hull would otherwise pass through the boundary
/// unseen.
constexpr double kLeastRadius = 1e-4, kLeastOfThin = 0.1;
/// Of the diagonal, by which triangles may be in hulls until they are made free in the end.
constexpr double kTolerance = 1e-8;

/// Random numbers that depend on the number of a draw alone, and not on the thread that takes it.
SplitMix numbers_of_draw(std::uint64_t draw) { return SplitMix(0x9e3779b97f4a7c15ull * (draw + 1)); }

double least_radius(const Solid& solid, std::span<const Ball> medial) {
  std::vector<double> radii;
  radii.reserve(medial.size());
  for (const Ball& ball : medial) radii.push_back(ball.radius);
  const auto tenth = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 10);
  std::nth_element(radii.begin(), tenth, radii.end());
  return std::min(kLeastRadius * solid.diagonal(), kLeastOfThin * *tenth);
}

}  // namespace

HullSearch::HullSearch(const Solid& solid, std::span<const Ball> medial, const SoughtHulls& shape,
                       const HullSearchEffort& effort, const Threads& threads)
    : solid_(solid),
      effort_(effort),
      threads_(threads),
      pool_(threads.count),
      radii_(solid, least_radius(solid, medial), kTolerance * solid.diagonal()),
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
      SplitMix random = numbers_of_draw(first + i);
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

/// Seeds where the solid is uncovered although all medial balls are covered, or lead to no hull: balls that touch the
/// boundary at points that are spread evenly over it, each time more of them. False where none is uncovered.
bool HullSearch::seed_at_boundary() {
  constexpr std::size_t kMostBoundarySeeds = kFirstBoundarySeeds << 4;
  std::vector<BallHull> hulls;
  for (std::size_t i = 0; i < lines_.size(); ++i) hulls.push_back(lines_.hull(i));
  while (boundary_seeds_ <= kMostBoundarySeeds) {
    const std::vector<Point> at = sample_surface(solid_.mesh().mesh, boundary_seeds_);
    std::vector<Ball> balls(at.size());
    pool_.run(at.size(), 16, [&](std::size_t i) {
      threads_.check();
      balls[i] = touching_ball(at[i]);
    });
    std::erase_if(balls, [&](const Ball& ball) { return !(ball.radius >= radii_.least()); });
    seeds_.take(balls, hulls);
    boundary_seeds_ *= 2;
    if (seeds_.any()) return true;
  }
  return false;
}

/// A ball that touches the boundary near one of its points and cannot grow; radius 0: none.
Ball HullSearch::touching_ball(const Point& at) const {
  const BvhHit hit = solid_.closest(at);
  const Triangle& corners = solid_.mesh().mesh.triangles[hit.triangle];
  const std::vector<Point>& vertices = solid_.mesh().mesh.vertices;
  const Point normal = cross(vertices[corners[1]] - vertices[corners[0]], vertices[corners[2]] - vertices[corners[0]]);
  const double size = length(normal);
  if (!(size > 0)) return {at, 0};
  const Point inside = at - (radii_.least() / size) * normal;
  return solid_.contains(inside) ? maximal_ball(solid_, inside) : Ball{at, 0};
}

bool HullSearch::grow() {
  while (seeds_.any() || seed_at_boundary()) {
    const Trial best = best_new(CoverageLines::kNone);
    if (best.gain > 0) {
      lines_.add(best.hull);
      seeds_.add(best.hull);
      seeds_.update();
      steps_.push_back(kPolishStep);
      return true;
    }
    if (!seed_at_boundary()) return false;
  }
  return false;
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
    steps_[i] = kPolishStep;
  }
}

}  // namespace medial_vk
