#include "sheets/join_components.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <numbers>
#include <numeric>
#include <queue>
#include <unordered_map>
#include <utility>

#include "sheets/spoke_turns.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Degrees: the greatest attraction of a point, and its greatest repulsion. A turn that is smaller than the limit by
/// kOpen or more has the greatest attraction, and one that is greater by kClosed or more the greatest repulsion. In
/// between, a sum of weights is continuous, while a count of points would jump.
constexpr double kOpen = 30, kClosed = 4;

/// A compact component of n points has a perimeter of 2 sqrt(pi n) points, so a border around all of it has twice as
/// many, counted on both sides. No border counts as less than about a quarter of that.
constexpr double kLeastBorder = 1.75;

/// Degrees are added up in millionths: sums of whole numbers are the same in any order.
constexpr double kUnit = 1e-6;

/// The border of two components: the points of either with a point of the other beside them. A point beside several
/// components counts for each, also after these have been joined.
struct Border {
  std::int64_t weight = 0;  // sum of the weights of the points, in kUnit degrees
  std::uint64_t points = 0;

  void add(const Border& other) {
    weight += other.weight;
    points += other.points;
  }
};

/// The least turn at a point towards another component, for the border of the two; the first number is below the
/// second.
struct LeastTurn {
  std::uint32_t first, second;
  float cosine;
};

void add_least_turns(const VoxelGraph& graph, const std::vector<std::uint32_t>& component_of, std::uint32_t position,
                     std::vector<LeastTurn>& out) {
  const std::uint32_t own = component_of[position];
  std::array<std::pair<std::uint32_t, float>, 26> others;  // components, and negated cosines
  std::size_t count = 0;
  for (const std::uint32_t other : graph.neighbours(position)) {
    if (component_of[other] == own) continue;
    const double cosine = cosine_of_turn(graph.sphere(position), graph.sphere(other));
    others[count++] = {component_of[other], static_cast<float>(-cosine)};
  }
  std::sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [component, cosine] = others[i];
    if (i == 0 || component != others[i - 1].first)
      out.push_back({std::min(own, component), std::max(own, component), -cosine});
  }
}

/// Of all points, ascending by components.
std::vector<LeastTurn> least_turns(const VoxelGraph& graph, const std::vector<std::uint32_t>& component_of) {
  std::vector<LeastTurn> turns;
  for (std::uint32_t position = 0; position < graph.size(); ++position)
    add_least_turns(graph, component_of, position, turns);
  std::ranges::sort(turns, {}, [](const LeastTurn& turn) { return std::pair(turn.first, turn.second); });
  return turns;
}

class Joining {
 public:
  Joining(const VoxelGraph& graph, double limit, std::vector<std::uint32_t>& component_of)
      : component_of_(component_of), limit_(limit) {
    for (const std::uint32_t component : component_of) {
      if (component >= points_.size()) points_.resize(component + std::size_t{1}, 0);
      ++points_[component];
    }
    into_.resize(points_.size());
    std::iota(into_.begin(), into_.end(), 0u);
    first_ = into_;
    neighbours_.resize(points_.size());
    const std::vector<LeastTurn> turns = least_turns(graph, component_of);
    for (const LeastTurn& turn : turns) enter(turn);
    for (std::uint32_t a = 0; a < neighbours_.size(); ++a) {
      for (const std::uint32_t b : neighbours_[a]) {
        if (a < b) queue(a, b, borders_.at(key(a, b)));
      }
    }
  }

  void run() {
    while (!queue_.empty()) {
      const Join strongest = queue_.top();
      queue_.pop();
      const auto& [a, b] = strongest.components;
      const auto border = borders_.find(key(a, b));
      if (border == borders_.end()) continue;  // one of the two has been joined to another
      // A border that has changed was queued again. Other weights only decrease as components grow.
      if (join_of(a, b, border->second) == strongest) {
        join(a, b);
      } else {
        queue(a, b, border->second);
      }
    }
    number_anew();
  }

 private:
  /// The greater one comes first: by weight, of equals by the order of voxels.
  struct Join {
    double weight;
    std::pair<std::uint32_t, std::uint32_t> first_voxels;  // of first_, with all bits inverted
    std::pair<std::uint32_t, std::uint32_t> components;

    auto operator<=>(const Join&) const = default;  // NOLINT(modernize-use-nullptr): false alarm of clang-tidy 14
  };

  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  void enter(const LeastTurn& turn) {
    const auto [border, is_new] = borders_.try_emplace(key(turn.first, turn.second));
    border->second.add(point_of_border(turn.cosine));
    if (!is_new) return;
    neighbours_[turn.first].push_back(turn.second);
    neighbours_[turn.second].push_back(turn.first);
  }

  Border point_of_border(float cosine) const {
    const double turn = std::acos(std::clamp(double{cosine}, -1.0, 1.0)) * 180 / std::numbers::pi;
    return {std::llround(std::clamp(limit_ - turn, -kClosed, kOpen) / kUnit), 1};
  }

  /// The weight in degrees times points, with the points missing to a border of the least length.
  double weight_of_border(std::uint32_t a, std::uint32_t b, const Border& border) const {
    const auto fewer = static_cast<double>(std::min(points_[a], points_[b]));
    const double missing = std::max(0.0, kLeastBorder * std::sqrt(fewer) - static_cast<double>(border.points));
    return static_cast<double>(border.weight) * kUnit - missing * kClosed;
  }

  Join join_of(std::uint32_t a, std::uint32_t b, const Border& border) const {
    const auto [first, second] = std::minmax(first_[a], first_[b]);
    return {weight_of_border(a, b, border), {~first, ~second}, {a, b}};
  }

  void queue(std::uint32_t a, std::uint32_t b, const Border& border) {
    const Join join = join_of(std::min(a, b), std::max(a, b), border);
    if (join.weight >= 0) queue_.push(join);
  }

  /// The component with fewer neighbours is joined to the other, so that n log n entries are moved in total.
  void join(std::uint32_t a, std::uint32_t b) {
    if (neighbours_[a].size() < neighbours_[b].size()) std::swap(a, b);
    into_[b] = a;
    first_[a] = std::min(first_[a], first_[b]);
    points_[a] += points_[b];
    borders_.erase(key(a, b));
    const std::vector<std::uint32_t> neighbours = std::exchange(neighbours_[b], {});
    for (const std::uint32_t neighbour : neighbours) {
      const std::uint32_t other = root(neighbour);
      auto border = borders_.extract(key(b, other));
      if (border.empty()) continue;  // a itself, or one met before as part of another
      border.key() = key(a, other);
      const auto inserted = borders_.insert(std::move(border));
      if (inserted.inserted) {
        neighbours_[a].push_back(other);
      } else {
        inserted.position->second.add(inserted.node.mapped());
      }
      queue(a, other, inserted.position->second);
    }
  }

  std::uint32_t root(std::uint32_t component) {
    while (into_[component] != component) component = into_[component] = into_[into_[component]];
    return component;
  }

  void number_anew() {
    std::vector<std::uint32_t> number(into_.size(), kNone);
    std::uint32_t count = 0;
    for (std::uint32_t& component : component_of_) {
      std::uint32_t& now = number[root(component)];
      if (now == kNone) now = count++;
      component = now;
    }
  }

  std::vector<std::uint32_t>& component_of_;
  double limit_;                                       // degrees
  std::vector<std::uint64_t> points_;                  // by component
  std::vector<std::uint32_t> into_;                    // by component: itself, or the one that it was joined to
  std::vector<std::uint32_t> first_;                   // by component: the first of its original components
  std::unordered_map<std::uint64_t, Border> borders_;  // by two components
  // By component: those that it has borders with, by former numbers.
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::priority_queue<Join> queue_;
};

}  // namespace

void join_components(const VoxelGraph& graph, const SheetOptions& options, std::vector<std::uint32_t>& component_of) {
  if (options.crease == 0) return;
  Joining(graph, options.border, component_of).run();
}

}  // namespace medial_vk
