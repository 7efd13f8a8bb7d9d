#include "robots/share_out.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace medial_vk {
namespace {

/// The lower convex hull of points over 1, 2, 3 ...: what the next ball is worth on it, never more than the one before.
std::vector<double> gains_on_hull(const std::vector<double>& uncovered) {
  std::vector<std::size_t> hull;
  const auto slope = [&](std::size_t a, std::size_t b) {
    return (uncovered[b] - uncovered[a]) / static_cast<double>(b - a);
  };
  for (std::size_t i = 0; i < uncovered.size(); ++i) {
    while (hull.size() > 1 && slope(hull[hull.size() - 2], hull.back()) >= slope(hull.back(), i)) hull.pop_back();
    hull.push_back(i);
  }
  std::vector<double> gains;
  for (std::size_t i = 1; i < hull.size(); ++i) {
    gains.insert(gains.end(), hull[i] - hull[i - 1], std::max(0.0, -slope(hull[i - 1], hull[i])));
  }
  return gains;
}

/// The part's answer to "what is the next ball worth?" for any count.
class Need {
 public:
  explicit Need(const NeedCurve& curve) : is_ball_(curve.is_ball), gains_(gains_on_hull(curve.uncovered)) {
    tried_ = static_cast<double>(curve.uncovered.size());
    if (curve.uncovered.empty()) return;
    last_ = std::max(curve.uncovered.back(), 0.0);
    const double middle = std::max(curve.uncovered[curve.uncovered.size() / 2], 0.0);
    const double from = static_cast<double>(curve.uncovered.size() / 2 + 1);
    // Error falls at least as count^-0.6 on smooth solids; a curve that is flat says that too few balls were tried.
    if (last_ > 0 && tried_ > from + 1) power_ = std::log(middle / last_) / std::log(tried_ / from);
    power_ = std::clamp(power_, 0.6, 2.0);
  }

  double gain(std::size_t balls) const {
    if (is_ball_) return -1;
    if (balls - 1 < gains_.size()) return gains_[balls - 1];
    const double now = std::max(static_cast<double>(balls), 1.0);
    return last_ * (std::pow(tried_ / now, power_) - std::pow(tried_ / (now + 1), power_));
  }

 private:
  bool is_ball_;
  std::vector<double> gains_;
  double tried_ = 1, last_ = 0, power_ = 0.6;
};

}  // namespace

std::vector<std::size_t> share_out(std::span<const NeedCurve> curves, std::size_t total) {
  std::vector<std::size_t> counts(curves.size(), 1);
  std::vector<Need> needs;
  for (const NeedCurve& curve : curves) needs.emplace_back(curve);
  struct Offer {
    double gain;
    std::size_t part;
    bool operator<(const Offer& other) const { return gain != other.gain ? gain < other.gain : part > other.part; }
  };
  std::priority_queue<Offer> offers;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!curves[i].is_ball) offers.push({needs[i].gain(1), i});
  }
  for (std::size_t given = curves.size(); given < total && !offers.empty(); ++given) {
    const std::size_t part = offers.top().part;
    offers.pop();
    ++counts[part];
    offers.push({needs[part].gain(counts[part]), part});
  }
  return counts;
}

}  // namespace medial_vk
