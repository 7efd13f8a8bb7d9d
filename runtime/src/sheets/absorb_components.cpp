#include "sheets/absorb_components.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "sheets/rim.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kFree = 0xffffffffu;

class Absorption {
 public:
  Absorption(const VoxelGraph& graph, double voxel_size, const SheetOptions& options,
             std::vector<std::uint32_t>& component_of)
      : graph_(graph),
        voxel_size_(voxel_size),
        options_(options),
        component_of_(component_of),
        nearest_(graph.size(), kFree),
        is_small_(graph.size()) {
    for (std::uint32_t position = 0; position < graph.size(); ++position) {
      if (component_of[position] >= positions_.size()) positions_.resize(component_of[position] + std::size_t{1});
      positions_[component_of[position]].push_back(position);
    }
  }

  Absorbed run() {
    const std::vector<std::uint32_t> before = component_of_;
    judge_components();
    set_small_components_free();
    assign_components(front_of_free_positions());
    for (std::uint32_t position = 0; position < graph_.size(); ++position) {
      if (is_free(position)) unite(position, before[position]);
    }
    return count(before);
  }

 private:
  void judge_components() {
    parallel_for(positions_.size(), 16, options_.threads, [&](std::size_t component) { judge(positions_[component]); });
  }

  void judge(std::span<const std::uint32_t> component) {
    const std::uint8_t small = is_small(component) ? 1 : 0;
    for (const std::uint32_t position : component) is_small_[position] = small;
  }

  /// Frees the points of small components that touch others.
  void set_small_components_free() {
    std::vector<std::uint8_t> goes(positions_.size());
    parallel_for(positions_.size(), 16, options_.threads, [&](std::size_t component) {
      const auto touches = [&](std::uint32_t position) { return is_at_border(position); };
      goes[component] =
          is_small_[positions_[component].front()] && std::ranges::any_of(positions_[component], touches) ? 1 : 0;
    });
    for (std::size_t component = 0; component < goes.size(); ++component) {
      if (!goes[component]) continue;
      for (const std::uint32_t position : positions_[component]) component_of_[position] = kFree;
    }
  }

  bool is_small(std::span<const std::uint32_t> component) {
    const auto ends = [&](std::uint32_t position) { return is_at_border(position) || is_rim(graph_, position); };
    if (std::ranges::none_of(component, ends)) return false;  // around a cavity, of any width
    if (component.size() < options_.absorb_fragments) return true;
    double radii = 0;
    for (const std::uint32_t position : component) radii += graph_.sphere(position).radius;
    const double diameter = 2 * radii / static_cast<double>(component.size());
    // Rims lie somewhere in their voxels: the component is at least as wide as the sum of its depths on both sides, and
    // may be wider by a voxel. Where a voxel is wide enough for these balls, the grid cannot distinguish narrow
    // components.
    if (voxel_size_ >= options_.width * diameter) return false;
    return 2 * greatest_depth(component) < options_.width * diameter;
  }

  bool is_at_border(std::uint32_t position) const {
    return std::ranges::any_of(graph_.neighbours(position),
                               [&](std::uint32_t other) { return component_of_[other] != component_of_[position]; });
  }

  /// Half the width of the widest strip that fits. Proceeds voxel by voxel from borders and rims inwards; every point
  /// receives the nearest border or rim point from its predecessors, and the greatest of these distances is the result.
  double greatest_depth(std::span<const std::uint32_t> component) {
    const std::uint32_t own = component_of_[component.front()];
    std::vector<std::uint32_t> front;
    std::ranges::copy_if(component, std::back_inserter(front),
                         [&](std::uint32_t position) { return is_at_border(position) || is_rim(graph_, position); });
    for (const std::uint32_t position : front) nearest_[position] = position;
    std::vector<std::uint32_t> reached;
    double depth = 0;
    while (!front.empty()) {
      reached.clear();
      for (const std::uint32_t position : front) {
        for (const std::uint32_t other : graph_.neighbours(position)) {
          if (component_of_[other] != own) continue;
          if (nearest_[other] == kFree) reached.push_back(other);
          if (nearest_[other] == kFree || distance(other, nearest_[position]) < distance(other, nearest_[other])) {
            nearest_[other] = nearest_[position];
          }
        }
      }
      for (const std::uint32_t position : front) depth = std::max(depth, distance(position, nearest_[position]));
      front.swap(reached);
    }
    return depth;
  }

  double distance(std::uint32_t a, std::uint32_t b) const {
    return length(graph_.sphere(a).centre - graph_.sphere(b).centre);
  }

  bool is_free(std::uint32_t position) const { return component_of_[position] == kFree; }

  std::vector<std::uint32_t> front_of_free_positions() const {
    std::vector<std::uint32_t> front;
    for (std::uint32_t position = 0; position < graph_.size(); ++position) {
      const auto around = graph_.neighbours(position);
      if (is_free(position) && !std::ranges::all_of(around, [&](std::uint32_t other) { return is_free(other); })) {
        front.push_back(position);
      }
    }
    return front;
  }

  /// Assigns components layer by layer; points of one layer do not depend on each other's components.
  void assign_components(std::vector<std::uint32_t> front) {
    std::vector<std::uint32_t> components, next;
    while (!front.empty()) {
      components.clear();
      for (const std::uint32_t position : front) components.push_back(component_around(position));
      for (std::size_t i = 0; i < front.size(); ++i) component_of_[front[i]] = components[i];
      next.clear();
      for (const std::uint32_t position : front) {
        std::ranges::copy_if(graph_.neighbours(position), std::back_inserter(next),
                             [&](std::uint32_t other) { return is_free(other); });
      }
      std::ranges::sort(next);
      next.erase(std::unique(next.begin(), next.end()), next.end());
      front.swap(next);
    }
  }

  /// The component that has most of the voxels around; of equals, the first. Precondition: not all of these are free.
  std::uint32_t component_around(std::uint32_t position) const {
    std::array<std::uint32_t, 26> components;
    std::size_t count = 0;
    for (const std::uint32_t other : graph_.neighbours(position)) {
      if (!is_free(other)) components[count++] = component_of_[other];
    }
    std::sort(components.begin(), components.begin() + static_cast<std::ptrdiff_t>(count));
    std::size_t most = 0;
    std::uint32_t best = kFree;
    for (std::size_t first = 0, i = 0; i < count; ++i) {
      if (components[i] != components[first]) first = i;
      if (i + 1 - first <= most) continue;
      most = i + 1 - first;
      best = components[i];
    }
    return best;
  }

  /// All free points connected with this one become a component, which is judged in turn.
  void unite(std::uint32_t position, std::uint32_t component) {
    std::vector<std::uint32_t> united = {position};
    component_of_[position] = component;
    for (std::size_t i = 0; i < united.size(); ++i) {
      nearest_[united[i]] = kFree;
      for (const std::uint32_t other : graph_.neighbours(united[i])) {
        if (!is_free(other)) continue;
        component_of_[other] = component;
        united.push_back(other);
      }
    }
    judge(united);
  }

  Absorbed count(const std::vector<std::uint32_t>& before) {
    Absorbed absorbed;
    absorbed.is_small = std::move(is_small_);
    std::vector<bool> is_left(positions_.size());
    for (std::size_t position = 0; position < before.size(); ++position) {
      if (component_of_[position] != before[position]) ++absorbed.points;
      is_left[component_of_[position]] = true;
    }
    absorbed.components = static_cast<std::uint64_t>(std::ranges::count(is_left, false));
    return absorbed;
  }

  const VoxelGraph& graph_;
  double voxel_size_;
  const SheetOptions& options_;
  std::vector<std::uint32_t>& component_of_;           // by position: its component, or kFree while it is free
  std::vector<std::vector<std::uint32_t>> positions_;  // by component, as at the beginning
  std::vector<std::uint32_t> nearest_;  // by position: the nearest border or rim point of its component, once measured
  std::vector<std::uint8_t> is_small_;  // by position
};

}  // namespace

Absorbed absorb_components(const VoxelGraph& graph, double voxel_size, const SheetOptions& options,
                           std::vector<std::uint32_t>& component_of) {
  return Absorption(graph, voxel_size, options, component_of).run();
}

}  // namespace medial_vk
