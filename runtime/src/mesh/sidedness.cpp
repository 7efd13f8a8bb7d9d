#include "mesh/sidedness.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "base/parallel.h"
#include "base/point_ops.h"
#include "mesh/winding/winding_number.h"
#include "mesh/winding/winding_step.h"
#include "mesh/winding_change.h"

namespace medial_vk {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// Half a percent of the full solid angle does not define a side; a plane sheet has 0 on both.
constexpr float kClear = 0.05f;

/// The values at which something about a triangle changes: that it is turned over, trusted, or encloses something.
constexpr std::array<float, 7> kThresholds = {-kClear, -kSideError,    kEncloses, kSideError,
                                              kClear,  1 - kSideError, 1.0f};

double distance_to_threshold(double w) {
  double least = std::numeric_limits<double>::infinity();
  for (const float threshold : kThresholds) least = std::min(least, std::abs(w - double{threshold}));
  return least;
}

double farthest_corner(const std::array<Point, 3>& corners, const Point& p) {
  return std::max({length(corners[0] - p), length(corners[1] - p), length(corners[2] - p)});
}

class SideFinder {
 public:
  SideFinder(Mesh& mesh, MeshTopology& topology, TriangleTree& tree, const SurfaceParts& parts, bool closed,
             const SelfIntersections& intersections, unsigned threads)
      : mesh_(mesh),
        topology_(topology),
        tree_(tree),
        parts_(parts),
        closed_(closed),
        intersections_(intersections),
        threads_(threads) {
    sides_.beside.assign(mesh.triangles.size(), kUnknown);
    position_of_.resize(mesh.triangles.size());
    for (std::uint32_t position = 0; position < tree.order.size(); ++position)
      position_of_[tree.order[position]] = position;
    area_.resize(mesh.triangles.size());
    for (std::size_t position = 0; position < area_.size(); ++position) {
      const auto& c = tree.corners[position];
      area_[tree.order[position]] = length(cross(c[1] - c[0], c[2] - c[0])) / 2;
    }
  }

  Sidedness run() {
    // Components that may be evaluated patch by patch.
    std::vector<bool> is_simple(parts_.components, closed_ && intersections_.known);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (intersections_.crossed[t]) is_simple[parts_.component_of[t]] = false;
    }
    evaluate_patches(is_simple);
    std::vector<std::uint32_t> rest;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!is_simple[parts_.component_of[t]]) rest.push_back(t);
    }
    if (rest.empty()) return std::move(sides_);
    evaluate(rest);
    if (turn_components(rest)) evaluate(rest);
    return std::move(sides_);
  }

 private:
  /// One value per patch, beside its largest triangle, which usually is the farthest from other triangles.
  void evaluate_patches(const std::vector<bool>& is_simple) {
    std::vector<std::uint32_t> largest(parts_.patches, kNoTriangle);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!is_simple[parts_.component_of[t]]) continue;
      std::uint32_t& best = largest[parts_.patch_of[t]];
      if (best == kNoTriangle || area_[t] > area_[best]) best = t;
    }
    std::vector<std::uint32_t> positions;
    for (const std::uint32_t t : largest) {
      if (t != kNoTriangle) positions.push_back(position_of_[t]);
    }
    std::sort(positions.begin(), positions.end());
    const std::vector<float> found = evaluate_closed(positions);
    std::vector<float> value(parts_.patches, kUnknown);
    for (std::size_t i = 0; i < positions.size(); ++i) value[parts_.patch_of[tree_.order[positions[i]]]] = found[i];
    std::vector<bool> counted(parts_.components, false);
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!is_simple[parts_.component_of[t]]) continue;
      const float w = value[parts_.patch_of[t]];
      sides_.beside[t] = std::abs(w);
      if (w >= 0) continue;
      turn(t);
      if (!counted[parts_.component_of[t]]) ++sides_.turned_components;
      counted[parts_.component_of[t]] = true;
    }
  }

  /// Where patches are large and close to each other, a value from the tree evaluates every triangle. So most values
  /// are those of their neighbours in the tree, plus the crossings between.
  std::vector<float> evaluate_closed(const std::vector<std::uint32_t>& positions) const {
    std::vector<std::optional<int>> step(positions.size());
    parallel_for(positions.size(), 16, threads_, [&](std::size_t i) {
      std::uint64_t cost = 0;
      if (i > 0) step[i] = winding_step(tree_, positions[i - 1], positions[i], cost);
    });
    std::vector<float> value(positions.size());
    const WindingTree winding(tree_);
    parallel_for(positions.size(), 16, threads_, [&](std::size_t i) {
      if (!step[i]) value[i] = half_integer(winding.beside(positions[i]));
    });
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (step[i]) value[i] = value[i - 1] + static_cast<float>(*step[i]);
    }
    return value;
  }

  /// Beside a closed surface only ..., -1/2, 1/2, 3/2, ... are possible; the tree's error is far below the step.
  static float half_integer(double w) { return static_cast<float>(std::floor(w) + 0.5); }

  /// A value holds for the neighbours beside which the winding number cannot be on the other side of a threshold. Where
  /// all groups of triangles overlap, one value evaluates every triangle, and all values take the square of their
  /// number. So each block of the tree has an allowance, which it spends evenly over its triangles; the rest stay
  /// unknown. A block's work does not depend on other blocks, nor the result on the number of threads.
  void evaluate(const std::vector<std::uint32_t>& triangles) {
    const WindingTree winding(tree_);
    std::vector<bool> wanted(mesh_.triangles.size(), false);
    for (const std::uint32_t t : triangles) wanted[t] = true;
    const std::size_t positions = tree_.order.size();
    // The number of blocks is limited, as the last value of each may exceed its allowance by all triangles.
    constexpr std::size_t kMostBlocks = 1024;
    const std::size_t block = std::max<std::size_t>(256, (positions + kMostBlocks - 1) / kMostBlocks);
    const std::size_t blocks = (positions + block - 1) / block;
    // Evaluations of triangles, some seconds in total and more for larger meshes. Ordinary meshes take 70 to 500 per
    // value.
    constexpr std::uint64_t kSmallMesh = 50'000'000, kPerTriangle = 2000;
    const std::uint64_t allowance = kSmallMesh / blocks + kPerTriangle * block;
    const WindingChange change(mesh_, topology_);
    std::atomic<bool> complete = true;
    parallel_for(blocks, 1, threads_, [&](std::size_t i) {
      const Block of = {i * block, std::min((i + 1) * block, positions), allowance};
      if (!evaluate_block(winding, change, wanted, of)) complete = false;
    });
    sides_.known = sides_.known && complete;
  }

  struct Block {
    std::size_t first, last;  // positions in the tree
    std::uint64_t allowance;
  };

  /// By position: neighbours in the tree take similar walks. False if the allowance was used up.
  bool evaluate_block(const WindingTree& winding, const WindingChange& change, const std::vector<bool>& wanted,
                      const Block& block) {
    std::uint64_t cost = 0;
    std::vector<char> is_known(block.last - block.first, 0);
    constexpr std::size_t kPasses = 16;
    for (std::size_t pass = 0; pass < kPasses; ++pass) {
      for (std::size_t position = block.first + pass; position < block.last; position += kPasses) {
        const std::uint32_t t = tree_.order[position];
        if (!wanted[t] || is_known[position - block.first]) continue;
        if (cost > block.allowance) return false;
        const double w = winding.beside(static_cast<std::uint32_t>(position), cost);
        // A crossed triangle has no single value.
        const bool is_crossed = intersections_.crossed[t];
        sides_.beside[t] = closed_ && !is_crossed ? half_integer(w) : static_cast<float>(w);
        if (!is_crossed && intersections_.known) spread(position, w, change, wanted, block, is_known);
      }
    }
    return true;
  }

  /// From the triangle at `position` to its neighbours in the block.
  void spread(std::size_t position, double w, const WindingChange& change, const std::vector<bool>& wanted,
              const Block& block, std::vector<char>& is_known) {
    const auto& c = tree_.corners[position];
    const Point centre = (1.0 / 3) * (c[0] + c[1] + c[2]);
    const double radius = change.radius(centre, distance_to_threshold(w), farthest_corner(c, centre));
    if (radius == 0) return;
    const std::uint32_t start = tree_.order[position];
    visit_neighbours(mesh_, topology_, start, centre, radius, [&](std::uint32_t t) {
      const std::size_t at = position_of_[t];
      if (at < block.first || at >= block.last || !wanted[t] || is_known[at - block.first]) return false;
      if (intersections_.crossed[t]) return false;
      is_known[at - block.first] = 1;
      sides_.beside[t] = sides_.beside[start];
      return true;
    });
    is_known[position - block.first] = 1;
  }

  bool turn_components(const std::vector<std::uint32_t>& triangles) {
    struct Vote {
      double area = 0, for_it = 0, against = 0;
    };
    std::vector<Vote> votes(parts_.components);
    for (const std::uint32_t t : triangles) {
      Vote& vote = votes[parts_.component_of[t]];
      if (std::isnan(sides_.beside[t])) continue;
      vote.area += area_[t];
      if (sides_.beside[t] > kClear) vote.for_it += area_[t];
      if (sides_.beside[t] < -kClear) vote.against += area_[t];
    }
    std::vector<std::vector<std::uint32_t>> members(parts_.components);
    const auto suspect = [&](const Vote& v) { return v.against > 2 * v.for_it && 2 * v.against > v.area; };
    for (const std::uint32_t t : triangles) {
      if (suspect(votes[parts_.component_of[t]])) members[parts_.component_of[t]].push_back(t);
    }
    bool any = false;
    for (const auto& component : members) {
      if (component.empty() || !is_inside_out_by_itself(component)) continue;
      for (const std::uint32_t t : component) turn(t);
      ++sides_.turned_components;
      any = true;
    }
    return any;
  }

  /// The sum over up to 64 of its triangles of the winding number beside them, of this component alone, by area.
  bool is_inside_out_by_itself(const std::vector<std::uint32_t>& component) const {
    const std::size_t step = std::max<std::size_t>(1, component.size() / 64);
    const std::size_t samples = (component.size() + step - 1) / step;
    std::vector<double> found(samples, 0);
    parallel_for(samples, 4, threads_, [&](std::size_t i) {
      const std::uint32_t at = component[i * step];
      const auto& c = tree_.corners[position_of_[at]];
      const Point centroid = c[0] + (1.0 / 3) * ((c[1] - c[0]) + (c[2] - c[0]));
      for (const std::uint32_t t : component) {
        if (t != at) found[i] += triangle_winding(tree_.corners[position_of_[t]], centroid);
      }
      found[i] *= area_[at];
    });
    double sum = 0;
    for (const double w : found) sum += w;
    return sum < 0;
  }

  void turn(std::uint32_t t) {
    turn_triangle(mesh_, topology_, t);
    std::swap(tree_.corners[position_of_[t]][1], tree_.corners[position_of_[t]][2]);
    ++sides_.turned_faces;
  }

  Mesh& mesh_;
  MeshTopology& topology_;
  TriangleTree& tree_;
  const SurfaceParts& parts_;
  const bool closed_;
  const SelfIntersections& intersections_;
  const unsigned threads_;
  std::vector<std::uint32_t> position_of_;
  std::vector<double> area_;
  Sidedness sides_;
};

}  // namespace

Sidedness decide_sides(Mesh& mesh, MeshTopology& topology, TriangleTree& tree, const SurfaceParts& parts, bool closed,
                       const SelfIntersections& intersections, unsigned threads) {
  return SideFinder(mesh, topology, tree, parts, closed, intersections, threads).run();
}

}  // namespace medial_vk
