#include "proximity/groups/exchange.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "proximity/groups/smallest_ball_centre.h"

namespace medial_vk {
namespace {

using Members = std::vector<std::uint32_t>;

class Exchange {
 public:
  Exchange(const IndexedBalls& balls, std::size_t most, std::span<const std::span<std::uint32_t>> parts)
      : balls_(balls), most_(most) {
    for (const auto& part : parts) parts_.push_back(measured({part.begin(), part.end()}));
  }

  void run() {
    bool has_changed = true;
    for (std::size_t round = 0; round < kMostRounds && has_changed; ++round) {
      has_changed = false;
      for (std::size_t p = 0; p < parts_.size(); ++p) has_changed = improve(p) || has_changed;
    }
  }

  const Members& members(std::size_t part) const { return parts_[part].members; }

 private:
  // Larger numbers hardly reduce the pairs of nodes that searches compare (docs/decisions.md).
  static constexpr std::size_t kSteps = 24, kTries = 3, kNearParts = 4, kMostRounds = 32;

  struct Part {
    Members members;
    Point middle = {0, 0, 0};
    double radius = 0;
  };

  /// What two parts would become.
  struct Change {
    double gain = 0;
    std::size_t p = 0, q = 0;
    Part new_p, new_q;
  };

  /// From the middle to the farthest point of ball `i`.
  double reach(const Part& part, std::uint32_t i) const {
    return length(balls_.centres[i] - part.middle) + balls_.radii[i];
  }

  Part measured(Members members) const {
    Part part{std::move(members), {0, 0, 0}, 0};
    Point mean = {0, 0, 0};
    for (const std::uint32_t i : part.members) mean = mean + balls_.centres[i];
    mean = (1.0 / static_cast<double>(part.members.size())) * mean;
    part.middle = near_smallest_ball_centre(mean, kSteps, [&](const auto& visit) {
      for (const std::uint32_t i : part.members) visit(balls_.centres[i], balls_.radii[i]);
    });
    for (const std::uint32_t i : part.members) part.radius = std::max(part.radius, reach(part, i));
    return part;
  }

  /// The kTries members with the largest values of `value`, the largest first; the smaller index of equal ones.
  template <class Value>
  Members largest(const Members& members, const Value& value) const {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (const std::uint32_t i : members) order.emplace_back(-value(i), i);
    const std::size_t count = std::min(kTries, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
    Members chosen;
    for (std::size_t k = 0; k < count; ++k) chosen.push_back(order[k].second);
    return chosen;
  }

  /// The other parts out of whose balls ball `i` reaches least.
  std::vector<std::size_t> parts_near(std::uint32_t i, std::size_t p) const {
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t q = 0; q < parts_.size(); ++q) {
      if (q != p) order.emplace_back(reach(parts_[q], i) - parts_[q].radius, q);
    }
    std::ranges::sort(order);
    std::vector<std::size_t> chosen;
    for (std::size_t k = 0; k < std::min(kNearParts, order.size()); ++k) chosen.push_back(order[k].second);
    return chosen;
  }

  /// Makes the best change that gives away one of the members of part `p` that reach farthest, if one is better than
  /// none.
  bool improve(std::size_t p) {
    const Part& part = parts_[p];
    for (const std::uint32_t i : largest(part.members, [&](std::uint32_t j) { return reach(part, j); })) {
      Change best;
      for (const std::size_t q : parts_near(i, p)) consider(i, p, q, best);
      if (best.gain <= 0) continue;
      parts_[best.p] = std::move(best.new_p);
      parts_[best.q] = std::move(best.new_q);
      return true;
    }
    return false;
  }

  void consider(std::uint32_t i, std::size_t p, std::size_t q, Change& best) const {
    const Part &from = parts_[p], &to = parts_[q];
    Members rest = from.members, more = to.members;
    std::erase(rest, i);
    more.push_back(i);
    if (!rest.empty() && to.members.size() < most_) consider(p, rest, q, more, best);
    for (const std::uint32_t j : largest(to.members, [&](std::uint32_t k) { return reach(to, k) - reach(from, k); })) {
      Members swapped = rest, with = more;
      swapped.push_back(j);
      std::erase(with, j);
      consider(p, std::move(swapped), q, std::move(with), best);
    }
  }

  void consider(std::size_t p, Members of_p, std::size_t q, Members of_q, Change& best) const {
    const auto square = [](const Part& part) { return part.radius * part.radius; };
    const double now = square(parts_[p]) + square(parts_[q]);
    Part new_p = measured(std::move(of_p));
    if (now - square(new_p) <= best.gain) return;
    Part new_q = measured(std::move(of_q));
    // Less than this may be rounding, and would let exchanges go round.
    const double gain = now - square(new_p) - square(new_q) - 1e-9 * now;
    if (gain > best.gain) best = {gain, p, q, std::move(new_p), std::move(new_q)};
  }

  const IndexedBalls balls_;
  std::size_t most_;
  std::vector<Part> parts_;
};

}  // namespace

void exchange(const IndexedBalls& balls, std::size_t most, std::vector<std::span<std::uint32_t>>& parts) {
  Exchange work(balls, most, parts);
  work.run();
  std::uint32_t* place = parts.front().data();
  for (const auto& part : parts) place = std::min(place, part.data());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Members& members = work.members(p);
    std::ranges::copy(members, place);
    parts[p] = {place, members.size()};
    place += members.size();
  }
}

}  // namespace medial_vk
