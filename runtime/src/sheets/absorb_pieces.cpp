#include "sheets/absorb_pieces.h"

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
             std::vector<std::uint32_t>& piece_of)
      : graph_(graph),
        voxel_size_(voxel_size),
        options_(options),
        piece_of_(piece_of),
        nearest_(graph.size(), kFree),
        is_small_(graph.size()) {
    for (std::uint32_t place = 0; place < graph.size(); ++place) {
      if (piece_of[place] >= places_.size()) places_.resize(piece_of[place] + std::size_t{1});
      places_[piece_of[place]].push_back(place);
    }
  }

  Absorbed run() {
    const std::vector<std::uint32_t> before = piece_of_;
    judge_pieces();
    set_small_pieces_free();
    hand_out(front_of_free_places());
    for (std::uint32_t place = 0; place < graph_.size(); ++place) {
      if (is_free(place)) unite(place, before[place]);
    }
    return count(before);
  }

 private:
  void judge_pieces() {
    parallel_for(places_.size(), 16, options_.threads, [&](std::size_t piece) { judge(places_[piece]); });
  }

  void judge(std::span<const std::uint32_t> piece) {
    const std::uint8_t small = is_small(piece) ? 1 : 0;
    for (const std::uint32_t place : piece) is_small_[place] = small;
  }

  /// Frees the points of small components that touch others.
  void set_small_pieces_free() {
    std::vector<std::uint8_t> goes(places_.size());
    parallel_for(places_.size(), 16, options_.threads, [&](std::size_t piece) {
      const auto touches = [&](std::uint32_t place) { return is_at_border(place); };
      goes[piece] = is_small_[places_[piece].front()] && std::ranges::any_of(places_[piece], touches) ? 1 : 0;
    });
    for (std::size_t piece = 0; piece < goes.size(); ++piece) {
      if (!goes[piece]) continue;
      for (const std::uint32_t place : places_[piece]) piece_of_[place] = kFree;
    }
  }

  bool is_small(std::span<const std::uint32_t> piece) {
    const auto ends = [&](std::uint32_t place) { return is_at_border(place) || is_rim(graph_, place); };
    if (std::ranges::none_of(piece, ends)) return false;  // around a cavity, of any width
    if (piece.size() < options_.absorb_fragments) return true;
    double radii = 0;
    for (const std::uint32_t place : piece) radii += graph_.sphere(place).radius;
    const double diameter = 2 * radii / static_cast<double>(piece.size());
    // Rims lie somewhere in their voxels: the component is at least as wide as the sum of its depths on both sides, and
    // may be wider by a voxel. Where a voxel is wide enough for these balls, the grid cannot distinguish narrow
    // components.
    if (voxel_size_ >= options_.width * diameter) return false;
    return 2 * greatest_depth(piece) < options_.width * diameter;
  }

  bool is_at_border(std::uint32_t place) const {
    return std::ranges::any_of(graph_.neighbours(place),
                               [&](std::uint32_t other) { return piece_of_[other] != piece_of_[place]; });
  }

  /// Half the width of the widest strip that fits. Proceeds voxel by voxel from borders and rims inwards; every point
  /// receives the nearest border or rim point from its predecessors, and the greatest of these distances is the result.
  double greatest_depth(std::span<const std::uint32_t> piece) {
    const std::uint32_t own = piece_of_[piece.front()];
    std::vector<std::uint32_t> front;
    std::ranges::copy_if(piece, std::back_inserter(front),
                         [&](std::uint32_t place) { return is_at_border(place) || is_rim(graph_, place); });
    for (const std::uint32_t place : front) nearest_[place] = place;
    std::vector<std::uint32_t> reached;
    double depth = 0;
    while (!front.empty()) {
      reached.clear();
      for (const std::uint32_t place : front) {
        for (const std::uint32_t other : graph_.neighbours(place)) {
          if (piece_of_[other] != own) continue;
          if (nearest_[other] == kFree) reached.push_back(other);
          if (nearest_[other] == kFree || distance(other, nearest_[place]) < distance(other, nearest_[other])) {
            nearest_[other] = nearest_[place];
          }
        }
      }
      for (const std::uint32_t place : front) depth = std::max(depth, distance(place, nearest_[place]));
      front.swap(reached);
    }
    return depth;
  }

  double distance(std::uint32_t a, std::uint32_t b) const {
    return length(graph_.sphere(a).centre - graph_.sphere(b).centre);
  }

  bool is_free(std::uint32_t place) const { return piece_of_[place] == kFree; }

  std::vector<std::uint32_t> front_of_free_places() const {
    std::vector<std::uint32_t> front;
    for (std::uint32_t place = 0; place < graph_.size(); ++place) {
      const auto around = graph_.neighbours(place);
      if (is_free(place) && !std::ranges::all_of(around, [&](std::uint32_t other) { return is_free(other); })) {
        front.push_back(place);
      }
    }
    return front;
  }

  /// Assigns components layer by layer; points of one layer do not depend on each other's components.
  void hand_out(std::vector<std::uint32_t> front) {
    std::vector<std::uint32_t> pieces, next;
    while (!front.empty()) {
      pieces.clear();
      for (const std::uint32_t place : front) pieces.push_back(piece_around(place));
      for (std::size_t i = 0; i < front.size(); ++i) piece_of_[front[i]] = pieces[i];
      next.clear();
      for (const std::uint32_t place : front) {
        std::ranges::copy_if(graph_.neighbours(place), std::back_inserter(next),
                             [&](std::uint32_t other) { return is_free(other); });
      }
      std::ranges::sort(next);
      next.erase(std::unique(next.begin(), next.end()), next.end());
      front.swap(next);
    }
  }

  /// The component that has most of the voxels around; of equals, the first. Precondition: not all of these are free.
  std::uint32_t piece_around(std::uint32_t place) const {
    std::array<std::uint32_t, 26> pieces;
    std::size_t count = 0;
    for (const std::uint32_t other : graph_.neighbours(place)) {
      if (!is_free(other)) pieces[count++] = piece_of_[other];
    }
    std::sort(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(count));
    std::size_t most = 0;
    std::uint32_t best = kFree;
    for (std::size_t first = 0, i = 0; i < count; ++i) {
      if (pieces[i] != pieces[first]) first = i;
      if (i + 1 - first <= most) continue;
      most = i + 1 - first;
      best = pieces[i];
    }
    return best;
  }

  /// All free points connected with this one become a component, which is judged in turn.
  void unite(std::uint32_t place, std::uint32_t piece) {
    std::vector<std::uint32_t> united = {place};
    piece_of_[place] = piece;
    for (std::size_t i = 0; i < united.size(); ++i) {
      nearest_[united[i]] = kFree;
      for (const std::uint32_t other : graph_.neighbours(united[i])) {
        if (!is_free(other)) continue;
        piece_of_[other] = piece;
        united.push_back(other);
      }
    }
    judge(united);
  }

  Absorbed count(const std::vector<std::uint32_t>& before) {
    Absorbed absorbed;
    absorbed.is_small = std::move(is_small_);
    std::vector<bool> is_left(places_.size());
    for (std::size_t place = 0; place < before.size(); ++place) {
      if (piece_of_[place] != before[place]) ++absorbed.points;
      is_left[piece_of_[place]] = true;
    }
    absorbed.pieces = static_cast<std::uint64_t>(std::ranges::count(is_left, false));
    return absorbed;
  }

  const VoxelGraph& graph_;
  double voxel_size_;
  const SheetOptions& options_;
  std::vector<std::uint32_t>& piece_of_;            // by position: its component, or kNone while it is free
  std::vector<std::vector<std::uint32_t>> places_;  // by component, as at the beginning
  std::vector<std::uint32_t> nearest_;  // by position: the nearest border or rim point of its component, once measured
  std::vector<std::uint8_t> is_small_;  // by position
};

}  // namespace

Absorbed absorb_pieces(const VoxelGraph& graph, double voxel_size, const SheetOptions& options,
                       std::vector<std::uint32_t>& piece_of) {
  return Absorption(graph, voxel_size, options, piece_of).run();
}

}  // namespace medial_vk
