#include "part_fits/distribute_balls.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

namespace medial_vk {
namespace {

/// On smooth solids the error falls at least like this power of the count.
constexpr double kLeastPower = 0.6, kGreatestPower = 2;

/// The decrease of an error by the power law when a ball is added to `balls`.
double fall(double error, double balls, double power) { return error * (1 - std::pow(balls / (balls + 1), power)); }

/// The worth of the next ball to the part, for any count.
class Need {
 public:
  explicit Need(const NeedCurve& curve) : is_ball_(curve.is_ball), ends_(curve.ends) {
    for (const double error : curve.uncovered) errors_.push_back(std::max(error, 0.0));
    if (errors_.empty()) return;
    const std::size_t middle = (errors_.size() - 1) / 2;
    if (errors_.back() <= 0 || middle + 2 > errors_.size()) return;
    const double ratio = static_cast<double>(errors_.size()) / static_cast<double>(middle + 1);
    power_ = std::clamp(std::log(errors_[middle] / errors_.back()) / std::log(ratio), kLeastPower, kGreatestPower);
  }

  double gain(std::size_t balls) const {
    if (is_ball_ || errors_.empty()) return -1;
    const double now = static_cast<double>(balls);
    if (balls < errors_.size()) return std::max(gain_on_curve(balls), fall(errors_[balls - 1], now, kLeastPower));
    if (ends_) return -1;
    const double error = errors_.back() * std::pow(static_cast<double>(errors_.size()) / now, power_);
    return fall(error, now, power_);
  }

 private:
  /// The greatest average over the next few balls.
  double gain_on_curve(std::size_t balls) const {
    double most = 0;
    const std::size_t end = std::min(errors_.size(), curve_length(balls));
    for (std::size_t next = balls + 1; next <= end; ++next) {
      most = std::max(most, (errors_[balls - 1] - errors_[next - 1]) / static_cast<double>(next - balls));
    }
    return most;
  }

  bool is_ball_, ends_;
  std::vector<double> errors_;  // with 1, 2, 3 ... balls
  double power_ = kLeastPower;
};

/// Every next ball goes to the part for which `worth(part, balls)` is greatest.
std::vector<std::size_t> distribute_by(std::span<const NeedCurve> curves, std::size_t total,
                                       const std::function<double(std::size_t, std::size_t)>& worth) {
  std::vector<std::size_t> counts(curves.size(), 1);
  struct Offer {
    double gain;
    std::size_t part;
    bool operator<(const Offer& other) const { return gain != other.gain ? gain < other.gain : part > other.part; }
  };
  std::priority_queue<Offer> offers;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!curves[i].is_ball) offers.push({worth(i, 1), i});
  }
  for (std::size_t given = curves.size(); given < total && !offers.empty(); ++given) {
    const std::size_t part = offers.top().part;
    offers.pop();
    ++counts[part];
    offers.push({worth(part, counts[part]), part});
  }
  return counts;
}

double gap_of(const NeedCurve& curve, std::size_t balls) {
  if (curve.gaps.empty() || (curve.ends && balls >= curve.gaps.size())) return -1;
  if (balls <= curve.gaps.size()) return curve.gaps[balls - 1];
  return curve.gaps.back() * std::sqrt(static_cast<double>(curve.gaps.size()) / static_cast<double>(balls));
}

}  // namespace

std::size_t curve_length(std::size_t count) { return count + std::max<std::size_t>(4, count / 4); }

std::vector<std::size_t> distribute_balls(std::span<const NeedCurve> curves, std::size_t total) {
  std::vector<Need> needs;
  for (const NeedCurve& curve : curves) needs.emplace_back(curve);
  return distribute_by(curves, total, [&](std::size_t part, std::size_t balls) { return needs[part].gain(balls); });
}

std::vector<std::size_t> distribute_by_gap(std::span<const NeedCurve> curves, std::size_t total) {
  return distribute_by(curves, total, [&](std::size_t part, std::size_t balls) { return gap_of(curves[part], balls); });
}

}  // namespace medial_vk
