#include "sheets/absorb_pieces.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <utility>

#include "mesh/point_ops.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

struct Piece {
  std::vector<std::uint32_t> places;
  double radii = 0;                                ///< Sum.
  std::map<std::uint32_t, std::uint64_t> borders;  ///< Pairs of voxels that touch, by the other piece.
  double width = 0;                                ///< Over the mean diameter of its balls.
};

class Absorption {
 public:
  Absorption(const VoxelGraph& graph, double voxel_size, const SheetParameters& parameters,
             std::vector<std::uint32_t>& piece_of)
      : graph_(graph),
        voxel_size_(voxel_size),
        parameters_(parameters),
        piece_of_(piece_of),
        nearest_(graph.size(), kNone) {
    for (std::uint32_t place = 0; place < graph.size(); ++place) enter(place);
    into_.resize(pieces_.size());
    for (std::uint32_t i = 0; i < into_.size(); ++i) into_[i] = i;
  }

  Absorbed run() {
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) measure_and_ask(i);
    while (!queue_.empty()) {
      const auto [width, i] = queue_.top();
      queue_.pop();
      // What was asked before the piece changed has been asked again since.
      if (into_[i] == i && pieces_[i].width == width && is_small(pieces_[i])) absorb(i);
    }
    for (std::uint32_t& piece : piece_of_) piece = absorber(piece);
    return absorbed_;
  }

 private:
  using Turn = std::pair<double, std::uint32_t>;

  std::uint32_t absorber(std::uint32_t piece) {
    while (into_[piece] != piece) piece = into_[piece] = into_[into_[piece]];
    return piece;
  }

  void enter(std::uint32_t place) {
    const std::uint32_t own = piece_of_[place];
    if (own >= pieces_.size()) pieces_.resize(own + std::size_t{1});
    Piece& piece = pieces_[own];
    piece.places.push_back(place);
    piece.radii += graph_.sphere(place).radius;
    for (const std::uint32_t other : graph_.neighbours(place)) {
      if (piece_of_[other] != own) ++piece.borders[piece_of_[other]];
    }
  }

  bool is_small(const Piece& piece) const {
    return !piece.borders.empty() &&
           (piece.width < parameters_.width || piece.places.size() < parameters_.absorb_fragments);
  }

  bool is_at_border(std::uint32_t place, std::uint32_t own) {
    return std::ranges::any_of(graph_.neighbours(place),
                               [&](std::uint32_t other) { return absorber(piece_of_[other]) != own; });
  }

  /// Voxel by voxel from its borders inwards, with the nearest point of the border that a point heard of from those
  /// before it: the distance of the farthest. What lies beside a rim is not at a border.
  double greatest_depth(std::uint32_t own) {
    std::vector<std::uint32_t> front, reached;
    for (const std::uint32_t place : pieces_[own].places) {
      if (!is_at_border(place, own)) continue;
      nearest_[place] = place;
      front.push_back(place);
    }
    double depth = 0;
    while (!front.empty()) {
      reached.clear();
      for (const std::uint32_t place : front) {
        for (const std::uint32_t other : graph_.neighbours(place)) {
          if (absorber(piece_of_[other]) != own) continue;
          if (nearest_[other] == kNone) reached.push_back(other);
          if (nearest_[other] == kNone || distance(other, nearest_[place]) < distance(other, nearest_[other])) {
            nearest_[other] = nearest_[place];
          }
        }
      }
      for (const std::uint32_t place : front) depth = std::max(depth, distance(place, nearest_[place]));
      front.swap(reached);
    }
    for (const std::uint32_t place : pieces_[own].places) nearest_[place] = kNone;
    return depth;
  }

  double distance(std::uint32_t a, std::uint32_t b) const {
    return length(graph_.sphere(a).centre - graph_.sphere(b).centre);
  }

  void measure_and_ask(std::uint32_t i) {
    Piece& piece = pieces_[i];
    if (piece.borders.empty()) return;
    // As wide as the widest strip that fits, from one voxel of the border to that on the other side.
    const double width = 2 * greatest_depth(i) + voxel_size_;
    const double diameter = 2 * piece.radii / static_cast<double>(piece.places.size());
    piece.width = diameter > 0 ? width / diameter : std::numeric_limits<double>::max();
    if (is_small(piece)) queue_.push({piece.width, i});
  }

  void absorb(std::uint32_t weak) {
    std::uint32_t other = weak;
    std::uint64_t most = 0;
    for (const auto& [piece, pairs] : pieces_[weak].borders) {
      if (pairs > most) {
        most = pairs;
        other = piece;
      }
    }
    ++absorbed_.pieces;
    absorbed_.points += pieces_[weak].places.size();
    // Nothing gets narrower by growing: only what was small is asked again.
    const bool ask_again = is_small(pieces_[other]);
    // The one with fewer voxels moves, so that all that is moved is n log n.
    const bool stays = pieces_[weak].places.size() > pieces_[other].places.size();
    const std::uint32_t from = stays ? other : weak, to = stays ? weak : other;
    const double width = pieces_[other].width;
    merge(from, to);
    pieces_[to].width = width;
    if (ask_again) measure_and_ask(to);
  }

  void merge(std::uint32_t from, std::uint32_t to) {
    Piece &gone = pieces_[from], &kept = pieces_[to];
    kept.places.insert(kept.places.end(), gone.places.begin(), gone.places.end());
    kept.radii += gone.radii;
    gone.borders.erase(to);
    kept.borders.erase(from);
    for (const auto& [piece, pairs] : gone.borders) {
      kept.borders[piece] += pairs;
      pieces_[piece].borders.erase(from);
      pieces_[piece].borders[to] += pairs;
    }
    gone = {};
    into_[from] = to;
  }

  const VoxelGraph& graph_;
  double voxel_size_;
  const SheetParameters& parameters_;
  std::vector<std::uint32_t>& piece_of_;
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> into_;     // by piece: itself, or the one that it went to
  std::vector<std::uint32_t> nearest_;  // by place: a place of the border; kNone except while its piece is measured
  std::priority_queue<Turn, std::vector<Turn>, std::greater<>> queue_;
  Absorbed absorbed_;
};

}  // namespace

Absorbed absorb_pieces(const VoxelGraph& graph, double voxel_size, const SheetParameters& parameters,
                       std::vector<std::uint32_t>& piece_of) {
  return Absorption(graph, voxel_size, parameters, piece_of).run();
}

}  // namespace medial_vk
