#include "sheets/join_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "sheets/spoke_turns.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Around a compact piece of n points there are 2 sqrt(pi n), so a border around all of it has twice as many, counted
/// on either side. No border counts as less than about two fifths of that.
constexpr double kLeastBorder = 3;

/// By point of either of two pieces with a point of the other beside it: the cosine of its least turn to these. The
/// greatest are kept apart from the rest, in heaps, so that the middle one is at hand after every change.
class Border {
 public:
  std::size_t size() const { return greatest_.size() + rest_.size(); }

  void add(float cosine) {
    const bool is_great = !greatest_.empty() && cosine > greatest_.front();
    is_great ? push(cosine, greatest_, std::greater<>()) : push(cosine, rest_, std::less<>());
  }

  /// Adds all that the smaller one has to the larger one, which stays here.
  void take(Border other) {
    if (size() < other.size()) std::swap(*this, other);
    for (const float cosine : other.greatest_) add(cosine);
    for (const float cosine : other.rest_) add(cosine);
  }

  /// Precondition: 1 <= n <= size(). While n does not fall, all calls together move as many turns as n and size() grow.
  float nth_greatest(std::size_t n) {
    while (greatest_.size() < n) push(pop(rest_, std::less<>()), greatest_, std::greater<>());
    while (greatest_.size() > n) push(pop(greatest_, std::greater<>()), rest_, std::less<>());
    return greatest_.front();
  }

 private:
  template <class Compare>
  static void push(float cosine, std::vector<float>& heap, Compare compare) {
    heap.push_back(cosine);
    std::push_heap(heap.begin(), heap.end(), compare);
  }

  template <class Compare>
  static float pop(std::vector<float>& heap, Compare compare) {
    std::pop_heap(heap.begin(), heap.end(), compare);
    const float cosine = heap.back();
    heap.pop_back();
    return cosine;
  }

  std::vector<float> greatest_;  // the least of them in front
  std::vector<float> rest_;      // the greatest of them in front
};

/// What a point has to say of the border of two pieces, the first number below the second.
struct LeastTurn {
  std::uint32_t first, second;
  float cosine;
};

void add_least_turns(const VoxelGraph& graph, const std::vector<std::uint32_t>& piece_of, std::uint32_t place,
                     std::vector<LeastTurn>& out) {
  const std::uint32_t own = piece_of[place];
  std::array<std::pair<std::uint32_t, float>, 26> others;  // pieces, and cosines, negative
  std::size_t count = 0;
  for (const std::uint32_t other : graph.neighbours(place)) {
    if (piece_of[other] == own) continue;
    const double cosine = cosine_of_turn(graph.sphere(place), graph.sphere(other));
    others[count++] = {piece_of[other], static_cast<float>(-cosine)};
  }
  std::sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [piece, cosine] = others[i];
    if (i == 0 || piece != others[i - 1].first) out.push_back({std::min(own, piece), std::max(own, piece), -cosine});
  }
}

/// Of all points, ascending by pieces.
std::vector<LeastTurn> least_turns(const VoxelGraph& graph, const std::vector<std::uint32_t>& piece_of) {
  std::vector<LeastTurn> turns;
  for (std::uint32_t place = 0; place < graph.size(); ++place) add_least_turns(graph, piece_of, place, turns);
  std::ranges::sort(turns, {}, [](const LeastTurn& turn) { return std::pair(turn.first, turn.second); });
  return turns;
}

class Joining {
 public:
  Joining(const VoxelGraph& graph, double least_cosine, std::vector<std::uint32_t>& piece_of)
      : piece_of_(piece_of), least_cosine_(least_cosine) {
    for (const std::uint32_t piece : piece_of) {
      if (piece >= points_.size()) points_.resize(piece + std::size_t{1}, 0);
      ++points_[piece];
    }
    into_.resize(points_.size());
    for (std::uint32_t i = 0; i < into_.size(); ++i) into_[i] = i;
    neighbours_.resize(points_.size());
    const std::vector<LeastTurn> turns = least_turns(graph, piece_of);
    for (const LeastTurn& turn : turns) enter(turn);
    for (std::uint32_t a = 0; a < neighbours_.size(); ++a) {
      for (const std::uint32_t b : neighbours_[a]) {
        if (a < b) queue(a, b, borders_.at(key(a, b)));
      }
    }
  }

  void run() {
    while (!queue_.empty()) {
      const auto [cosine, a, b] = queue_.top();
      queue_.pop();
      const auto border = borders_.find(key(a, b));
      if (border == borders_.end()) continue;  // one of the two is part of another now
      // A border that has changed was queued anew. Others only count for less as pieces grow.
      const double now = -cosine_of_border(a, b, border->second);
      if (now == cosine) {
        join(a, b);
      } else if (now > cosine) {
        queue(a, b, border->second);
      }
    }
    number_anew();
  }

 private:
  using Turn = std::tuple<double, std::uint32_t, std::uint32_t>;  // the cosine, negative, and two pieces, ascending

  static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
  }

  void enter(const LeastTurn& turn) {
    const auto [border, is_new] = borders_.try_emplace(key(turn.first, turn.second));
    border->second.add(turn.cosine);
    if (!is_new) return;
    neighbours_[turn.first].push_back(turn.second);
    neighbours_[turn.second].push_back(turn.first);
  }

  /// -1 if most of the border is missing.
  double cosine_of_border(std::uint32_t a, std::uint32_t b, Border& border) const {
    const auto fewer = static_cast<double>(std::min(points_[a], points_[b]));
    const double points = std::max(static_cast<double>(border.size()), kLeastBorder * std::sqrt(fewer));
    const auto middle = static_cast<std::size_t>(std::ceil(points / 2));
    return middle > border.size() ? -1 : double{border.nth_greatest(middle)};
  }

  void queue(std::uint32_t a, std::uint32_t b, Border& border) {
    const double cosine = cosine_of_border(a, b, border);
    if (cosine >= least_cosine_) queue_.push({-cosine, std::min(a, b), std::max(a, b)});
  }

  /// The one with fewer neighbours goes into the other, so that all that is moved is n log n.
  void join(std::uint32_t a, std::uint32_t b) {
    if (neighbours_[a].size() < neighbours_[b].size()) std::swap(a, b);
    into_[b] = a;
    points_[a] += points_[b];
    borders_.erase(key(a, b));
    const std::vector<std::uint32_t> neighbours = std::exchange(neighbours_[b], {});
    for (const std::uint32_t neighbour : neighbours) {
      const std::uint32_t other = root(neighbour);
      auto border = borders_.extract(key(b, other));
      if (border.empty()) continue;  // a itself, or one that has come before as part of another
      border.key() = key(a, other);
      const auto inserted = borders_.insert(std::move(border));
      if (inserted.inserted) {
        neighbours_[a].push_back(other);
      } else {
        inserted.position->second.take(std::move(inserted.node.mapped()));
      }
      queue(a, other, inserted.position->second);
    }
  }

  std::uint32_t root(std::uint32_t piece) {
    while (into_[piece] != piece) piece = into_[piece] = into_[into_[piece]];
    return piece;
  }

  void number_anew() {
    std::vector<std::uint32_t> number(into_.size(), kNone);
    std::uint32_t count = 0;
    for (std::uint32_t& piece : piece_of_) {
      std::uint32_t& now = number[root(piece)];
      if (now == kNone) now = count++;
      piece = now;
    }
  }

  std::vector<std::uint32_t>& piece_of_;
  double least_cosine_;
  std::vector<std::uint64_t> points_;                  // by piece
  std::vector<std::uint32_t> into_;                    // by piece: itself, or the one that it went to
  std::unordered_map<std::uint64_t, Border> borders_;  // by two pieces
  // By piece: those that it has borders with, by numbers that they had once.
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::priority_queue<Turn, std::vector<Turn>, std::greater<>> queue_;
};

}  // namespace

void join_pieces(const VoxelGraph& graph, const SheetParameters& parameters, std::vector<std::uint32_t>& piece_of) {
  if (parameters.crease == 0) return;
  Joining(graph, std::cos(parameters.border * std::numbers::pi / 180), piece_of).run();
}

}  // namespace medial_vk
