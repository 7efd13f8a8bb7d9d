#include "pairing.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "base/point_ops.h"
#include "bounding_ball.h"
#include "principal_axes.h"

namespace medial_vk::bench {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// Joins the chosen balls, which it reorders, and returns their node.
std::uint32_t join(std::span<const Ball> balls, std::span<std::uint32_t> chosen, Pairing& pairing) {
  if (chosen.size() == 1) return chosen.front();
  const PrincipalAxes spread(balls, chosen);
  const auto middle = std::partition(chosen.begin(), chosen.end(), [&](std::uint32_t i) {
    return dot(spread.axes[0], balls[i].centre - spread.centroid) < 0;
  });
  auto cut = static_cast<std::size_t>(middle - chosen.begin());
  if (cut == 0 || cut == chosen.size()) cut = chosen.size() / 2;  // concentric balls
  const std::uint32_t first = join(balls, chosen.first(cut), pairing);
  const std::uint32_t second = join(balls, chosen.subspan(cut), pairing);
  pairing.pairs.push_back({first, second});
  return static_cast<std::uint32_t>(pairing.nodes() - 1);
}

/// The same, with cuts that halve the likelihood.
std::uint32_t join_likely(std::span<const Ball> balls, std::span<const double> likelihoods,
                          std::span<std::uint32_t> chosen, Pairing& pairing) {
  if (chosen.size() == 1) return chosen.front();
  const PrincipalAxes spread(balls, chosen);
  std::ranges::sort(chosen, {}, [&](std::uint32_t i) { return dot(spread.axes[0], balls[i].centre); });
  double all = 0;
  for (const std::uint32_t i : chosen) all += likelihoods[i];
  std::size_t cut = 1;
  for (double before = likelihoods[chosen[0]]; cut + 1 < chosen.size(); ++cut) {
    // One more on this side, if that is nearer to a half.
    const double next = likelihoods[chosen[cut]];
    if (before + next / 2 > all / 2) break;
    before += next;
  }
  const std::uint32_t first = join_likely(balls, likelihoods, chosen.first(cut), pairing);
  const std::uint32_t second = join_likely(balls, likelihoods, chosen.subspan(cut), pairing);
  pairing.pairs.push_back({first, second});
  return static_cast<std::uint32_t>(pairing.nodes() - 1);
}

/// Nodes that no pair holds yet, each with the partner that gives the smallest ball.
class Clusters {
 public:
  explicit Clusters(std::span<const Ball> balls) : balls_(balls) {
    for (std::uint32_t i = 0; i < balls.size(); ++i) clusters_.push_back({i, {i}, {balls[i].centre, balls[i].radius}});
    for (std::uint32_t i = 0; i < clusters_.size(); ++i) find_partner(i);
  }

  std::size_t size() const { return clusters_.size(); }

  /// Joins the best two as `node`, and returns the nodes that they were.
  std::array<std::uint32_t, 2> join_best(std::uint32_t node) {
    const auto best = static_cast<std::uint32_t>(
        std::ranges::min_element(clusters_, {}, &Cluster::radius_with_partner) - clusters_.begin());
    const std::uint32_t i = std::min(best, clusters_[best].partner), j = std::max(best, clusters_[best].partner);
    const std::array<std::uint32_t, 2> joined = {clusters_[i].node, clusters_[j].node};
    Cluster& cluster = clusters_[i];
    cluster.node = node;
    cluster.balls.insert(cluster.balls.end(), clusters_[j].balls.begin(), clusters_[j].balls.end());
    cluster.ball = BoundingBall::around(balls_, cluster.balls);
    remove(j);
    for (std::uint32_t k = 0; k < clusters_.size(); ++k) {
      const std::uint32_t partner = clusters_[k].partner;
      if (k == i || partner == i || partner == kNone) find_partner(k);
    }
    for (std::uint32_t k = 0; k < clusters_.size(); ++k) {
      if (k != i) consider(k, i);
    }
    return joined;
  }

 private:
  struct Cluster {
    std::uint32_t node;
    std::vector<std::uint32_t> balls;
    BoundingBall ball;
    std::uint32_t partner = kNone;  // its place
    double radius_with_partner = std::numeric_limits<double>::infinity();
  };

  /// Of the smallest ball around two.
  static double radius_around(const BoundingBall& a, const BoundingBall& b) {
    return std::max({a.radius, b.radius, (length(a.centre - b.centre) + a.radius + b.radius) / 2});
  }

  void consider(std::uint32_t i, std::uint32_t partner) {
    const double radius = radius_around(clusters_[i].ball, clusters_[partner].ball);
    if (radius >= clusters_[i].radius_with_partner) return;
    clusters_[i].radius_with_partner = radius;
    clusters_[i].partner = partner;
  }

  void find_partner(std::uint32_t i) {
    clusters_[i].partner = kNone;
    clusters_[i].radius_with_partner = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < clusters_.size(); ++k) {
      if (k != i) consider(i, k);
    }
  }

  /// The last cluster takes its place. Those whose partner was removed have none.
  void remove(std::uint32_t place) {
    const auto last = static_cast<std::uint32_t>(clusters_.size() - 1);
    if (place != last) clusters_[place] = std::move(clusters_[last]);
    clusters_.pop_back();
    for (Cluster& cluster : clusters_) {
      cluster.partner = cluster.partner == place ? kNone : cluster.partner == last ? place : cluster.partner;
    }
  }

  std::span<const Ball> balls_;
  std::vector<Cluster> clusters_;
};

}  // namespace

Pairing pair_top_down(std::span<const Ball> balls) {
  Pairing pairing{balls.size(), {}};
  std::vector<std::uint32_t> all(balls.size());
  std::iota(all.begin(), all.end(), 0u);
  if (!all.empty()) join(balls, all, pairing);
  return pairing;
}

Pairing pair_by_likelihood(std::span<const Ball> balls, std::span<const double> likelihoods) {
  Pairing pairing{balls.size(), {}};
  std::vector<std::uint32_t> all(balls.size());
  std::iota(all.begin(), all.end(), 0u);
  if (!all.empty()) join_likely(balls, likelihoods, all, pairing);
  return pairing;
}

Pairing pair_bottom_up(std::span<const Ball> balls) {
  Pairing pairing{balls.size(), {}};
  Clusters clusters(balls);
  while (clusters.size() > 1) {
    pairing.pairs.push_back(clusters.join_best(static_cast<std::uint32_t>(pairing.nodes())));
  }
  return pairing;
}

}  // namespace medial_vk::bench
