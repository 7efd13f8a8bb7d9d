#include "sphere_fits/methods/nearness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>

#include "base/point_ops.h"
#include "sphere_fits/steps/ball_steps.h"
#include "sphere_fits/steps/maximal_ball.h"

namespace medial_vk {
namespace {

/// A choice of balls among candidates, from which the points outside of the probes are little farther than from the
/// solid: the sum of the squares of these differences is small. (Squares, because the greatest matter, too.) What a set
/// saves is a submodular function of it, as each point has the greatest of its balls' savings (facilities and clients),
/// so that old gains bound new ones.
class Choice {
 public:
  /// No difference is greater than the root of `greatest`.
  Choice(std::span<const Probe> probes, float greatest, std::vector<Ball> candidates, const Threads& threads)
      : candidates_(std::move(candidates)), threads_(threads), chosen_(candidates_.size()), far_(greatest) {
    for (const Probe& probe : probes) {
      const Point p = probe.outside();
      for (std::size_t k = 0; k < 3; ++k) at_[k].push_back(static_cast<float>(p[k]));
      from_solid_.push_back(static_cast<float>(probe.distance));
    }
    least_.assign(probes.size(), far_);
  }

  void offer(std::span<const Ball> candidates) {
    candidates_.insert(candidates_.end(), candidates.begin(), candidates.end());
    chosen_.resize(candidates_.size());
  }

  /// Chooses the first candidates for good.
  void keep(std::uint32_t count) {
    kept_ = count;
    for (std::uint32_t c = 0; c < count; ++c) choose(c);
  }

  void choose(std::uint32_t candidate) {
    chosen_[candidate] = true;
    visit(candidates_[candidate], [&](std::size_t i, float cost) { least_[i] = std::min(least_[i], cost); });
  }

  /// Adds the candidates of the greatest gains, one after the other.
  void add(std::size_t count) {
    std::vector<double> gains(candidates_.size());
    for_all(gains.size(), 8, threads_, [&](std::size_t i) { gains[i] = chosen_[i] ? 0 : gain(candidates_[i]); });
    std::priority_queue<Entry> queue;
    for (std::uint32_t i = 0; i < gains.size(); ++i) {
      if (gains[i] > 0) queue.push({gains[i], i, 0});
    }
    for (std::size_t round = 0; round < count && !queue.empty();) {
      Entry best = queue.top();
      queue.pop();
      if (best.round == round) {
        choose(best.candidate);
        ++round;
        continue;
      }
      threads_.check();
      best = {gain(candidates_[best.candidate]), best.candidate, round};
      if (best.gain > 0) queue.push(best);
    }
  }

  /// Removes the balls without which the sum of the distances grows least; none of those that are kept.
  void remove(std::size_t count) {
    std::vector<std::uint32_t> nearest(least_.size());
    std::vector<float> second(least_.size(), far_);
    std::fill(least_.begin(), least_.end(), far_);
    for (std::uint32_t c = 0; c < candidates_.size(); ++c) {
      if (!chosen_[c]) continue;
      visit(candidates_[c], [&](std::size_t i, float cost) {
        const bool is_nearest = cost < least_[i];
        second[i] = std::min(second[i], is_nearest ? least_[i] : cost);
        nearest[i] = is_nearest ? c : nearest[i];
        least_[i] = std::min(least_[i], cost);
      });
    }
    std::vector<double> losses(candidates_.size());
    for (std::size_t i = 0; i < least_.size(); ++i) losses[nearest[i]] += static_cast<double>(second[i]) - least_[i];
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t c = 0; c < candidates_.size(); ++c) {
      if (chosen_[c] && c >= kept_) order.emplace_back(losses[c], c);
    }
    std::sort(order.begin(), order.end());
    order.resize(std::min(order.size(), count));
    for (const auto& [loss, c] : order) chosen_[c] = false;
    std::fill(least_.begin(), least_.end(), far_);
    for (std::uint32_t c = 0; c < candidates_.size(); ++c) {
      if (chosen_[c]) choose(c);
    }
  }

  /// Of those points that are set in `among`, the ones with the greatest differences; by number.
  std::vector<std::size_t> farthest(std::size_t count, const std::vector<bool>& among) const {
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < least_.size(); ++i) {
      if (among[i]) points.push_back(i);
    }
    count = std::min(count, points.size());
    std::partial_sort(
        points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count), points.end(),
        [&](std::size_t a, std::size_t b) { return least_[a] != least_[b] ? least_[a] > least_[b] : a < b; });
    points.resize(count);
    return points;
  }

  /// Of the squares, over all points.
  double sum() const {
    double sum = 0;
    for (const float cost : least_) sum += cost;
    return sum;
  }

  /// By candidate.
  const std::vector<bool>& chosen() const { return chosen_; }
  const Ball& candidate(std::size_t i) const { return candidates_[i]; }

 private:
  struct Entry {
    double gain;
    std::uint32_t candidate;
    std::size_t round;
    bool operator<(const Entry& other) const {
      return gain != other.gain ? gain < other.gain : candidate > other.candidate;
    }
  };

  /// The squared difference for each point.
  template <class Visit>
  void visit(const Ball& ball, const Visit& visit) const {
    const auto x = static_cast<float>(ball.centre[0]), y = static_cast<float>(ball.centre[1]),
               z = static_cast<float>(ball.centre[2]), radius = static_cast<float>(ball.radius);
    for (std::size_t i = 0; i < least_.size(); ++i) {
      const float dx = at_[0][i] - x, dy = at_[1][i] - y, dz = at_[2][i] - z;
      const float more = std::max(0.0f, std::sqrt(dx * dx + dy * dy + dz * dz) - radius - from_solid_[i]);
      visit(i, more * more);
    }
  }

  double gain(const Ball& ball) const {
    constexpr std::size_t kLanes = 16;
    std::array<float, kLanes> sums{};
    visit(ball, [&](std::size_t i, float cost) { sums[i % kLanes] += std::max(0.0f, least_[i] - cost); });
    double sum = 0;
    for (const float each : sums) sum += each;
    return sum;
  }

  std::vector<Ball> candidates_;
  const Threads& threads_;
  std::vector<bool> chosen_;
  std::uint32_t kept_ = 0;
  float far_;
  std::array<std::vector<float>, 3> at_;  // the points outside, and
  std::vector<float> from_solid_;         // their distances from it
  std::vector<float> least_;              // the squares for the chosen balls
};

/// The largest balls that touch the boundary next to probes: there from inside, at several depths, as next to an edge
/// the depth determines the size.
std::vector<Ball> balls_at(const Solid& solid, std::span<const Probe> probes, const Threads& threads) {
  constexpr std::array<double, 3> kDepths = {1e-3, 6e-3, 3e-2};  // of the diagonal
  std::vector<Ball> found(kDepths.size() * probes.size());
  for_all(found.size(), 16, threads, [&](std::size_t i) {
    const Probe& probe = probes[i / kDepths.size()];
    const Point inside = probe.at - kDepths[i % kDepths.size()] * solid.diagonal() * probe.direction;
    if (!solid.contains(inside)) return;
    const Ball ball = maximal_ball(solid, inside);
    if (ball.radius > 0 && stays_inside(solid, ball)) found[i] = ball;
  });
  std::erase_if(found, [](const Ball& ball) { return !(ball.radius > 0); });
  return found;
}

/// The vertices of the mesh with the mean normals of their triangles; of more than a million every n-th.
std::vector<Probe> vertices_of(const Solid& solid) {
  constexpr std::size_t kMost = std::size_t{1} << 20;
  const Mesh& mesh = solid.mesh().mesh;
  std::vector<Point> normals(mesh.vertices.size(), Point{0, 0, 0});
  for (const auto& [i, j, k] : mesh.triangles) {
    const Point& a = mesh.vertices[i];
    const Point normal = cross(mesh.vertices[j] - a, mesh.vertices[k] - a);
    for (const std::uint32_t v : {i, j, k}) normals[v] = normals[v] + normal;
  }
  std::vector<Probe> vertices;
  for (std::size_t v = 0; v < normals.size(); v += (normals.size() + kMost - 1) / kMost) {
    const double size = length(normals[v]);
    if (size > 0) vertices.push_back({mesh.vertices[v], (1 / size) * normals[v], 0});
  }
  return vertices;
}

/// How far places of the boundary are from balls.
class Gaps {
 public:
  Gaps(std::span<const Probe> places, const Threads& threads) : places_(places), threads_(threads) {
    gaps_.assign(places.size(), std::numeric_limits<double>::infinity());
  }
  static double gap(const Probe& place, const Ball& ball) { return length(place.at - ball.centre) - ball.radius; }
  void add(std::span<const Ball> balls) {
    for_all(gaps_.size(), 256, threads_, [&](std::size_t i) {
      for (const Ball& ball : balls) gaps_[i] = std::min(gaps_[i], gap(places_[i], ball));
    });
  }
  std::size_t farthest() const {
    return static_cast<std::size_t>(std::max_element(gaps_.begin(), gaps_.end()) - gaps_.begin());
  }
  double operator[](std::size_t place) const { return gaps_[place]; }
  /// All places so near to one.
  void leave_out(std::size_t place, double distance) {
    const Ball around = {places_[place].at, distance};
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
      if (gap(places_[i], around) <= 0) gaps_[i] = -std::numeric_limits<double>::infinity();
    }
  }

 private:
  std::span<const Probe> places_;
  const Threads& threads_;
  std::vector<double> gaps_;
};

/// Up to `count` balls, each next to the vertex that is then farthest from all balls, such as a tip of a finger: the
/// interval to a body there is as wide as that, and few probes are so near. Every ball halves the gap or more. Where
/// none does, as on a thin sheet or within the solid, the vertices around are left out, too.
std::vector<Ball> balls_at_tips(const Solid& solid, std::span<const Ball> balls, std::size_t count,
                                const Threads& threads) {
  constexpr double kOutside = 1e-6;
  const std::vector<Probe> vertices = vertices_of(solid);
  std::vector<Ball> found;
  if (vertices.empty() || count == 0) return found;
  Gaps gaps(vertices, threads);
  gaps.add(balls);
  for (std::size_t tries = 0; tries < 4 * count && found.size() < count; ++tries) {
    threads.check();
    const std::size_t vertex = gaps.farthest();
    if (!(gaps[vertex] > 0)) break;
    const Probe& tip = vertices[vertex];
    std::vector<Ball> near;
    if (!solid.contains(tip.at + kOutside * solid.diagonal() * tip.direction)) {
      near = balls_at(solid, std::span(&tip, 1), threads);
    }
    const auto best = std::ranges::min_element(near, {}, [&](const Ball& ball) { return Gaps::gap(tip, ball); });
    if (best == near.end() || Gaps::gap(tip, *best) > 0.5 * gaps[vertex]) {
      gaps.leave_out(vertex, 0.5 * gaps[vertex]);
      continue;
    }
    found.push_back(*best);
    gaps.add(std::span(&*best, 1));
  }
  return found;
}

/// Three quarters: with more, the distances grow; with fewer, the uncovered volume does (docs/decisions.md).
std::size_t kept_of(std::size_t count) { return count - count / 4; }

/// Of those that are placed for distances, an eighth is for tips.
std::size_t at_tips_of(std::size_t placed) { return placed / 8; }

}  // namespace

std::vector<Ball> nearer_balls(const Solid& solid, std::span<const Ball> balls, std::span<const Probe> probes,
                               const Threads& threads) {
  constexpr std::size_t kRounds = 4, kOfRound = 8;
  const std::size_t count = balls.size(), kept = kept_of(count);
  if (kept == count) return {balls.begin(), balls.end()};
  std::vector<Ball> candidates(balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(kept));
  const std::vector<Ball> at_tips = balls_at_tips(solid, candidates, at_tips_of(count - kept), threads);
  candidates.insert(candidates.end(), at_tips.begin(), at_tips.end());
  const std::size_t fixed = candidates.size(), placed = count - fixed;
  candidates.insert(candidates.end(), balls.begin() + static_cast<std::ptrdiff_t>(kept), balls.end());
  const std::size_t served = std::min(probes.size(), 4 * count);
  const std::vector<Ball> more = balls_at(solid, probes.first(served), threads);
  candidates.insert(candidates.end(), more.begin(), more.end());
  Choice choice(probes, static_cast<float>(9 * solid.diagonal() * solid.diagonal()), std::move(candidates), threads);
  choice.keep(static_cast<std::uint32_t>(fixed));
  choice.add(placed);
  std::vector<bool> best = choice.chosen();
  double least = choice.sum();
  std::vector<bool> is_left(probes.size(), true);
  std::fill_n(is_left.begin(), served, false);
  for (std::size_t round = 0; round < kRounds; ++round) {
    // Points at a rare tip may be served by no ball yet.
    std::vector<Probe> far;
    for (const std::size_t i : choice.farthest(placed, is_left)) {
      is_left[i] = false;
      far.push_back(probes[i]);
    }
    choice.offer(balls_at(solid, far, threads));
    const std::size_t part = std::max<std::size_t>(1, placed / (kOfRound + 2 * round));
    choice.remove(part);
    choice.add(part);
    if (!(choice.sum() < least)) continue;
    least = choice.sum();
    best = choice.chosen();
  }
  std::vector<Ball> nearer;
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (best[i]) nearer.push_back(choice.candidate(i));
  }
  // Where further balls bring nothing nearer, as in a ball.
  for (std::size_t i = kept; i < count && nearer.size() < count; ++i) {
    if (!best[i - kept + fixed]) nearer.push_back(balls[i]);
  }
  return nearer;
}

}  // namespace medial_vk
