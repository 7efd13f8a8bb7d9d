#include "sheets/join_pieces.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "sheets/grow_pieces.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Pairs of voxels that touch across the border of two pieces.
struct Border {
  std::uint64_t pairs = 0, linked = 0;

  double share() const { return static_cast<double>(linked) / static_cast<double>(pairs); }
  bool is_open() const { return 2 * linked >= pairs; }
  void add(const Border& more) {
    pairs += more.pairs;
    linked += more.linked;
  }
};

class Joining {
 public:
  Joining(const VoxelGraph& graph, const LinkTest& linked, std::vector<std::uint32_t>& piece_of) : piece_of_(piece_of) {
    for (const std::uint32_t piece : piece_of)
      into_.resize(std::max<std::size_t>(into_.size(), piece + std::size_t{1}));
    for (std::uint32_t i = 0; i < into_.size(); ++i) into_[i] = i;
    borders_.resize(into_.size());
    for (std::uint32_t place = 0; place < graph.size(); ++place) {
      for (const std::uint32_t other : graph.neighbours(place)) {
        const std::uint32_t a = piece_of[place], b = piece_of[other];
        if (a == b) continue;  // every pair across is met from both sides, once for the border of either
        Border& border = borders_[a][b];
        ++border.pairs;
        if (linked(graph.sphere(place), graph.sphere(other))) ++border.linked;
      }
    }
    for (std::uint32_t a = 0; a < borders_.size(); ++a) queue_borders(a);
  }

  void run() {
    while (!queue_.empty()) {
      const auto [share, a, b] = *queue_.begin();
      queue_.erase(queue_.begin());
      join(a, b);
    }
    number_anew();
  }

 private:
  using Turn = std::tuple<double, std::uint32_t, std::uint32_t>;  // the share, negative: the largest comes first

  static Turn turn(std::uint32_t a, std::uint32_t b, const Border& border) {
    return {-border.share(), std::min(a, b), std::max(a, b)};
  }

  void queue_borders(std::uint32_t a) {
    for (const auto& [b, border] : borders_[a]) {
      if (border.is_open()) queue_.insert(turn(a, b, border));
    }
  }

  void leave_queue(std::uint32_t a) {
    for (const auto& [b, border] : borders_[a]) queue_.erase(turn(a, b, border));
  }

  /// The one with fewer borders goes into the other, so that all that is moved is n log n.
  void join(std::uint32_t a, std::uint32_t b) {
    if (borders_[a].size() < borders_[b].size()) std::swap(a, b);
    leave_queue(a);
    leave_queue(b);
    into_[b] = a;
    for (const auto& [other, border] : std::exchange(borders_[b], {})) {
      borders_[other].erase(b);
      if (other == a) continue;
      borders_[a][other].add(border);
      borders_[other][a].add(border);
    }
    queue_borders(a);
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
  std::vector<std::uint32_t> into_;                       // by piece: itself, or the one that it went to
  std::vector<std::map<std::uint32_t, Border>> borders_;  // by piece, by the other; the same from both sides
  std::set<Turn> queue_;
};

}  // namespace

void join_pieces(const VoxelGraph& graph, double object_angle, const SheetParameters& parameters,
                 std::vector<std::uint32_t>& piece_of) {
  if (parameters.crease == 0) return;
  Joining(graph, LinkTest(object_angle, parameters, kBorderTurn), piece_of).run();
}

}  // namespace medial_vk
