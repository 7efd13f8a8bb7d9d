#include "sheets/join_pieces.h"

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

/// Degrees: by how much a point speaks for a join at most, and against it. What turns by kOpen less than the limit is
/// as open as anything, what turns by kClosed more as closed; in between a sum does not jump where a count would.
constexpr double kOpen = 30, kClosed = 4;

/// Around a compact piece of n points there are 2 sqrt(pi n), so a border around all of it has twice as many, counted
/// on either side. No border counts as less than about a quarter of that.
constexpr double kLeastBorder = 1.75;

/// Degrees are added up in millionths: sums of whole numbers are the same in any order.
constexpr double kUnit = 1e-6;

/// Of the points of either of two pieces with a point of the other beside it. One that is beside several pieces counts
/// for each, also once these are one.
struct Border {
  std::int64_t pull = 0;  // in units: by how much their least turns to these are below the limit, the sum
  std::uint64_t points = 0;

  void add(const Border& other) {
    pull += other.pull;
    points += other.points;
  }
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
  Joining(const VoxelGraph& graph, double limit, std::vector<std::uint32_t>& piece_of)
      : piece_of_(piece_of), limit_(limit) {
    for (const std::uint32_t piece : piece_of) {
      if (piece >= points_.size()) points_.resize(piece + std::size_t{1}, 0);
      ++points_[piece];
    }
    into_.resize(points_.size());
    std::iota(into_.begin(), into_.end(), 0u);
    first_ = into_;
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
      const Join strongest = queue_.top();
      queue_.pop();
      const auto& [a, b] = strongest.pieces;
      const auto border = borders_.find(key(a, b));
      if (border == borders_.end()) continue;  // one of the two is part of another now
      // A border that has changed was queued anew. Others only pull less as pieces grow.
      if (join_of(a, b, border->second) == strongest) {
        join(a, b);
      } else {
        queue(a, b, border->second);
      }
    }
    number_anew();
  }

 private:
  /// The greater one comes first: the stronger pull, of equals one by the order of voxels.
  struct Join {
    double pull;
    std::pair<std::uint32_t, std::uint32_t> first_voxels;  // of first_, with all bits turned
    std::pair<std::uint32_t, std::uint32_t> pieces;

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

  /// Degrees times points, with what is missing to a border of the least length.
  double pull_of_border(std::uint32_t a, std::uint32_t b, const Border& border) const {
    const auto fewer = static_cast<double>(std::min(points_[a], points_[b]));
    const double missing = std::max(0.0, kLeastBorder * std::sqrt(fewer) - static_cast<double>(border.points));
    return static_cast<double>(border.pull) * kUnit - missing * kClosed;
  }

  Join join_of(std::uint32_t a, std::uint32_t b, const Border& border) const {
    const auto [first, second] = std::minmax(first_[a], first_[b]);
    return {pull_of_border(a, b, border), {~first, ~second}, {a, b}};
  }

  void queue(std::uint32_t a, std::uint32_t b, const Border& border) {
    const Join join = join_of(std::min(a, b), std::max(a, b), border);
    if (join.pull >= 0) queue_.push(join);
  }

  /// The one with fewer neighbours goes into the other, so that all that is moved is n log n.
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
      if (border.empty()) continue;  // a itself, or one that has come before as part of another
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
  double limit_;                                       // degrees
  std::vector<std::uint64_t> points_;                  // by piece
  std::vector<std::uint32_t> into_;                    // by piece: itself, or the one that it went to
  std::vector<std::uint32_t> first_;                   // by piece: the first of those that it is made of
  std::unordered_map<std::uint64_t, Border> borders_;  // by two pieces
  // By piece: those that it has borders with, by numbers that they had once.
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::priority_queue<Join> queue_;
};

}  // namespace

void join_pieces(const VoxelGraph& graph, const SheetOptions& parameters, std::vector<std::uint32_t>& piece_of) {
  if (parameters.crease == 0) return;
  Joining(graph, parameters.border, piece_of).run();
}

}  // namespace medial_vk
