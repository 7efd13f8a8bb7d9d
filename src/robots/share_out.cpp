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

/// Error falls at least like this power of the count on smooth solids.
constexpr double kLeastPower = 0.6, kGreatestPower = 2;

/// What the power law takes from an error when a ball is added to `balls`.
double fall(double error, double balls, double power) { return error * (1 - std::pow(balls / (balls + 1), power)); }

/// The part's answer to "what is the next ball worth?" for any count.
class Need {
 public:
  explicit Need(const NeedCurve& curve) : is_ball_(curve.is_ball), gains_(gains_on_hull(curve.uncovered)) {
    if (curve.uncovered.empty()) return;
    errors_.push_back(std::max(curve.uncovered.front(), 0.0));
    for (const double gain : gains_) errors_.push_back(std::max(errors_.back() - gain, 0.0));
    const std::size_t middle = (errors_.size() - 1) / 2;
    if (errors_.back() <= 0 || middle + 2 > errors_.size()) return;
    const double ratio = static_cast<double>(errors_.size()) / static_cast<double>(middle + 1);
    power_ = std::clamp(std::log(errors_[middle] / errors_.back()) / std::log(ratio), kLeastPower, kGreatestPower);
  }

  double gain(std::size_t balls) const {
    if (is_ball_ || errors_.empty()) return -1;
    const double now = static_cast<double>(balls);
    if (balls < errors_.size()) return std::max(gains_[balls - 1], fall(errors_[balls - 1], now, kLeastPower));
    const double error = errors_.back() * std::pow(static_cast<double>(errors_.size()) / now, power_);
    return fall(error, now, power_);
  }

 private:
  bool is_ball_;
  std::vector<double> gains_;
  std::vector<double> errors_;  // on the hull, with 1, 2, 3 ... balls
  double power_ = kLeastPower;
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
