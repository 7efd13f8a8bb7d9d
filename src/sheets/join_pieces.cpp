#include "sheets/join_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "sheets/spoke_turns.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

/// Around a compact piece of n points there are 2 sqrt(pi n), so a border around all of it has twice as many, counted
/// on either side. No border counts as less than about two fifths of that.
constexpr double kLeastBorder = 3;

/// By point of either of two pieces with a point of the other beside it: the cosine of its least turn to these.
using Border = std::vector<float>;

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
    borders_.resize(points_.size());
    for (std::uint32_t place = 0; place < graph.size(); ++place) enter(graph, place);
    for (std::uint32_t a = 0; a < borders_.size(); ++a) {
      for (const auto& [b, border] : borders_[a]) queue(a, b);
    }
  }

  void run() {
    while (!queue_.empty()) {
      const auto [cosine, a, b] = queue_.top();
      queue_.pop();
      const Border* border = find(a, b);
      if (border == nullptr) continue;  // one of the two is part of another now
      // A border that has changed was queued anew. Others only count for less as pieces grow.
      const double now = -cosine_of_border(a, b, *border);
      if (now == cosine) join(a, b);
      if (now > cosine) queue(a, b);
    }
    number_anew();
  }

 private:
  using Turn = std::tuple<double, std::uint32_t, std::uint32_t>;  // the cosine, negative, and two pieces, ascending

  /// Borders stand with the piece of the smaller number.
  void enter(const VoxelGraph& graph, std::uint32_t place) {
    const std::uint32_t own = piece_of_[place];
    std::map<std::uint32_t, float> greatest;
    for (const std::uint32_t other : graph.neighbours(place)) {
      const std::uint32_t piece = piece_of_[other];
      if (piece == own) continue;
      const auto cosine = static_cast<float>(cosine_of_turn(graph.sphere(place), graph.sphere(other)));
      const auto [at, is_new] = greatest.try_emplace(piece, cosine);
      if (!is_new) at->second = std::max(at->second, cosine);
    }
    for (const auto& [piece, cosine] : greatest) {
      borders_[std::min(own, piece)][std::max(own, piece)].push_back(cosine);
      if (piece < own) borders_[own].try_emplace(piece);  // empty: only says that there is one
    }
  }

  const Border* find(std::uint32_t a, std::uint32_t b) const {
    const auto found = borders_[a].find(b);
    return found == borders_[a].end() ? nullptr : &found->second;
  }

  /// -1 if most of the border is missing.
  double cosine_of_border(std::uint32_t a, std::uint32_t b, Border border) const {
    const auto fewer = static_cast<double>(std::min(points_[a], points_[b]));
    const double points = std::max(static_cast<double>(border.size()), kLeastBorder * std::sqrt(fewer));
    const auto middle = static_cast<std::size_t>(std::ceil(points / 2));
    if (middle > border.size()) return -1;
    const auto at = border.begin() + static_cast<std::ptrdiff_t>(middle - 1);
    std::nth_element(border.begin(), at, border.end(), std::greater<>());
    return double{*at};
  }

  void queue(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const double cosine = cosine_of_border(a, b, borders_[a].at(b));
    if (cosine >= least_cosine_) queue_.push({-cosine, a, b});
  }

  /// Takes the border of two pieces out.
  Border take(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    Border border = std::move(borders_[a].at(b));
    borders_[a].erase(b);
    borders_[b].erase(a);
    return border;
  }

  void add(std::uint32_t a, std::uint32_t b, Border more) {
    if (a > b) std::swap(a, b);
    borders_[b].try_emplace(a);
    Border& border = borders_[a][b];
    if (border.size() < more.size()) border.swap(more);
    border.insert(border.end(), more.begin(), more.end());
  }

  /// The one with fewer borders goes into the other, so that all that is moved is n log n.
  void join(std::uint32_t a, std::uint32_t b) {
    if (borders_[a].size() < borders_[b].size()) std::swap(a, b);
    take(a, b);
    into_[b] = a;
    points_[a] += points_[b];
    while (!borders_[b].empty()) {
      const std::uint32_t other = borders_[b].begin()->first;
      add(a, other, take(b, other));
      queue(a, other);
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
  std::vector<std::uint64_t> points_;                     // by piece
  std::vector<std::uint32_t> into_;                       // by piece: itself, or the one that it went to
  std::vector<std::map<std::uint32_t, Border>> borders_;  // by piece, by the other
  std::priority_queue<Turn, std::vector<Turn>, std::greater<>> queue_;
};

}  // namespace

void join_pieces(const VoxelGraph& graph, const SheetParameters& parameters, std::vector<std::uint32_t>& piece_of) {
  if (parameters.crease == 0) return;
  Joining(graph, std::cos(parameters.border * std::numbers::pi / 180), piece_of).run();
}

}  // namespace medial_vk
