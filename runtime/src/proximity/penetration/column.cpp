#include "proximity/penetration/column.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace medial_vk {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr std::size_t kCorners = 4, kMiddle = 4, kLines = 5;  // four vertical lines at the corners, one in the middle

/// The part of a vertical line in a ball; no part where `lower` is above `upper`.
struct Chord {
  double lower = 1, upper = -1;
  bool exists() const { return lower <= upper; }
};

/// The line through (x, y) in the ball, no longer than it is: r^2 - dx^2 - dy^2 has an error of less than
/// 8 u (r^2 + dx^2 + dy^2), its root one of 2 u more, and the sum with z one of u times its own size.
Chord chord_of(const Ball& ball, double x, double y) {
  const double dx = x - ball.centre[0], dy = y - ball.centre[1], r2 = ball.radius * ball.radius;
  const double across = dx * dx + dy * dy;
  const double half_squared = (r2 - across) - 16 * kUnit * (r2 + across);
  if (!(half_squared > 0)) return {};
  const double half = std::sqrt(half_squared) * (1 - 4 * kUnit);
  const double slack = 2 * kUnit * (std::fabs(ball.centre[2]) + half);
  return {ball.centre[2] - half + slack, ball.centre[2] + half - slack};
}

/// A ball with its chords over the corners and the middle of the rectangle. It is a pillar if its projection holds the
/// rectangle: within the rectangle the upper end is then a concave function, and the lower one convex.
struct Piece {
  const Ball* ball = nullptr;
  std::array<Chord, kLines> chords;
  double bottom = 0, top = 0;  ///< No point of the ball over the rectangle is lower or higher.
  Piece* below = nullptr;      ///< The one before it in a chain.
  bool matters = true;

  bool is_pillar() const {
    return std::ranges::all_of(chords, [](const Chord& chord) { return chord.exists(); });
  }
  double sum_of_uppers() const { return chords[0].upper + chords[1].upper + (chords[2].upper + chords[3].upper); }
  double sum_of_lowers() const { return chords[0].lower + chords[1].lower + (chords[2].lower + chords[3].lower); }
};

/// Over the whole rectangle two pillars overlap: the least upper end less the greatest lower one is concave, so it is
/// nowhere less than at the worst corner.
bool overlap(const Piece& p, const Piece& q) {
  for (std::size_t c = 0; c < kCorners; ++c) {
    if (p.chords[c].lower > q.chords[c].upper || q.chords[c].lower > p.chords[c].upper) return false;
  }
  return true;
}

/// No point of the ball over the rectangle is higher above the centre, or lower below it.
double greatest_half(const Ball& ball, const Rectangle& rectangle) {
  double across = 0;
  for (std::size_t k = 0; k < 2; ++k) {
    const double outside =
        std::max({0.0, rectangle.from[k] - ball.centre[k], ball.centre[k] - rectangle.to[k]}) * (1 - 4 * kUnit);
    across += outside * outside;
  }
  return std::sqrt(std::max(0.0, ball.radius * ball.radius * (1 + 8 * kUnit) - across)) * (1 + 8 * kUnit);
}

std::array<std::array<double, 2>, kLines> lines_of(const Rectangle& r) {
  return {{{r.from[0], r.from[1]},
           {r.to[0], r.from[1]},
           {r.from[0], r.to[1]},
           {r.to[0], r.to[1]},
           {0.5 * (r.from[0] + r.to[0]), 0.5 * (r.from[1] + r.to[1])}}};
}

void find_pieces(std::span<const Ball> balls, const Rectangle& rectangle, std::vector<Piece>& pieces) {
  const std::array<std::array<double, 2>, kLines> lines = lines_of(rectangle);
  pieces.clear();
  for (const Ball& ball : balls) {
    const double half = greatest_half(ball, rectangle);
    if (!(half > 0)) continue;
    const double slack = 4 * kUnit * (std::fabs(ball.centre[2]) + half);
    Piece& piece = pieces.emplace_back();
    piece.ball = &ball;
    piece.bottom = ball.centre[2] - half - slack;
    piece.top = ball.centre[2] + half + slack;
    for (std::size_t c = 0; c < kLines; ++c) piece.chords[c] = chord_of(ball, lines[c][0], lines[c][1]);
  }
}

/// Pillars of which each overlaps the one below it: over every point of the rectangle the union of their chords is one
/// segment, from no higher than those of the first to no lower than those of the last.
struct Chain {
  Piece* first;
  Piece* last;
};

/// From the lowest pillar up, always to one that reaches higher. Chains that could be joined may remain two: the bound
/// is then lower.
void find_chains(std::span<Piece> pieces, std::vector<std::pair<double, Piece*>>& pillars, std::vector<Chain>& chains) {
  pillars.clear();
  chains.clear();
  for (Piece& piece : pieces) {
    if (piece.is_pillar()) pillars.emplace_back(piece.sum_of_lowers(), &piece);
  }
  std::ranges::sort(pillars, {}, [](const auto& pillar) { return pillar.first; });
  for (const auto& entry : pillars) {
    Piece* const pillar = entry.second;
    const auto chain = std::ranges::find_if(chains, [&](const Chain& c) { return overlap(*c.last, *pillar); });
    if (chain == chains.end()) {
      chains.push_back({pillar, pillar});
    } else if (pillar->sum_of_uppers() > chain->last->sum_of_uppers()) {
      // One that overlaps an earlier pillar of the chain takes the place of those between.
      while (chain->last->below && overlap(*chain->last->below, *pillar)) chain->last = chain->last->below;
      pillar->below = chain->last;
      chain->last = pillar;
    }
  }
}

/// A part of the common volume: over each point of the rectangle from the greater of two lower ends to the lesser of
/// two upper ones.
struct Part {
  double mean = 0;          ///< Of its length at the corners.
  double from = 0, to = 0;  ///< It lies between.
};

/// By how much weights differ, where the middle is rounded: by less than u (|from| + |to|) / 2 along each axis, which
/// is a share of the side.
double error_of_weights(const Rectangle& r) {
  double share = 8 * kUnit;
  for (std::size_t k = 0; k < 2; ++k) {
    share += kUnit * (std::fabs(r.from[k]) + std::fabs(r.to[k])) / (r.to[k] - r.from[k]);
  }
  return share;
}

/// The length is a concave function, and so nowhere less than the linear ones over the four triangles from the middle
/// to two corners. Their integral is the area times a third of the length in the middle and a sixth of that at each
/// corner. Where the middle is off by the shares d and e of the sides, weights of corners differ by no more than (d +
/// e) / 6.
Part common_part(const Chain& a, const Chain& b, double weight_error) {
  Part part;
  double size = 0;
  for (std::size_t c = 0; c < kLines; ++c) {
    const double length = std::min(a.last->chords[c].upper, b.last->chords[c].upper) -
                          std::max(a.first->chords[c].lower, b.first->chords[c].lower);
    part.mean += (c == kMiddle ? 1.0 / 3 : 1.0 / 6) * length;
    size += std::fabs(length);
  }
  part.mean -= weight_error * size;  // lengths may have both signs
  part.from = std::max(a.first->bottom, b.first->bottom);
  part.to = std::min(a.last->top, b.last->top);
  return part;
}

/// The lengths of parts of which no two have a point in common, the longest first.
double sum_of_disjoint(std::vector<Part>& parts, std::vector<Part>& taken) {
  std::ranges::sort(parts, [](const Part& s, const Part& t) { return s.mean > t.mean; });
  double sum = 0;
  taken.clear();
  for (const Part& part : parts) {
    const auto is_apart = [&](const Part& other) { return other.to < part.from || part.to < other.from; };
    if (!std::ranges::all_of(taken, is_apart)) continue;
    taken.push_back(part);
    sum += part.mean;
  }
  sum *= 1 - 0x1p-53 * static_cast<double>(taken.size() + 1);  // the roundings of the sum
  return sum;
}

/// The length that both unions have in common on a line, up to rounding.
double common_length(std::span<const Piece> a, std::span<const Piece> b, std::size_t line,
                     std::array<std::vector<Chord>, 2>& scratch) {
  for (std::size_t set = 0; set < 2; ++set) {
    std::vector<Chord>& chords = scratch[set];
    chords.clear();
    for (const Piece& piece : set == 0 ? a : b) {
      if (piece.chords[line].exists()) chords.push_back(piece.chords[line]);
    }
    std::ranges::sort(chords, {}, &Chord::lower);
    std::size_t last = 0;
    for (std::size_t i = 1; i < chords.size(); ++i) {
      if (chords[i].lower <= chords[last].upper) {
        chords[last].upper = std::max(chords[last].upper, chords[i].upper);
      } else {
        chords[++last] = chords[i];
      }
    }
    if (!chords.empty()) chords.resize(last + 1);
  }
  double sum = 0;
  for (std::size_t i = 0, j = 0; i < scratch[0].size() && j < scratch[1].size();) {
    const Chord &p = scratch[0][i], &q = scratch[1][j];
    sum += std::max(0.0, std::min(p.upper, q.upper) - std::max(p.lower, q.lower));
    p.upper < q.upper ? ++i : ++j;
  }
  return sum;
}

/// Lets those pieces matter that do not lie between the ends of a chain, the chain itself, and of these those that are
/// not above or below all of the other set. To leave out balls lowers the bound at most.
void find_what_matters(std::span<Piece> pieces, std::span<const Chain> chains, std::span<const Piece> others) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const Chain& chain : chains) {
    double from = -kInfinity, to = kInfinity;
    for (std::size_t c = 0; c < kCorners; ++c) {
      from = std::max(from, chain.first->chords[c].lower);
      to = std::min(to, chain.last->chords[c].upper);
    }
    for (Piece& piece : pieces) piece.matters = piece.matters && (piece.bottom < from || piece.top > to);
  }
  for (const Chain& chain : chains) {
    for (Piece* piece = chain.last; piece; piece = piece->below) piece->matters = true;
  }
  double bottom = kInfinity, top = -kInfinity;
  for (const Piece& piece : others) {
    bottom = std::min(bottom, piece.bottom);
    top = std::max(top, piece.top);
  }
  for (Piece& piece : pieces) piece.matters = piece.matters && piece.bottom <= top && piece.top >= bottom;
}

std::vector<Ball> balls_of(std::span<const Piece> pieces) {
  std::vector<Ball> balls;
  balls.reserve(pieces.size());
  for (const Piece& piece : pieces) balls.push_back(*piece.ball);
  return balls;
}

}  // namespace

struct ColumnMeter::Memory {
  std::array<std::vector<Piece>, 2> pieces;
  std::array<std::vector<Chain>, 2> chains;
  std::array<std::vector<Chord>, 2> chords;
  std::vector<std::pair<double, Piece*>> pillars;
  std::vector<Part> parts, taken;
};

ColumnMeter::ColumnMeter() : memory_(std::make_unique<Memory>()) {}
ColumnMeter::~ColumnMeter() = default;

void ColumnMeter::measure(Column& column) {
  auto& [pieces, chains, chords, pillars, parts, taken] = *memory_;
  find_pieces(column.a, column.rectangle, pieces[0]);
  find_pieces(column.b, column.rectangle, pieces[1]);
  for (std::size_t set = 0; set < 2; ++set) find_chains(pieces[set], pillars, chains[set]);
  const double weight_error = error_of_weights(column.rectangle);
  parts.clear();
  for (const Chain& a : chains[0]) {
    for (const Chain& b : chains[1]) {
      const Part part = common_part(a, b, weight_error);
      if (part.mean > 0) parts.push_back(part);
    }
  }
  column.lower = sum_of_disjoint(parts, taken) * column.rectangle.area();
  for (std::size_t set = 0; set < 2; ++set) find_what_matters(pieces[set], chains[set], pieces[1 - set]);
  for (std::vector<Piece>& of_set : pieces) std::erase_if(of_set, [](const Piece& piece) { return !piece.matters; });
  double at_corners = 0;
  for (std::size_t c = 0; c < kCorners; ++c) at_corners += 0.25 * common_length(pieces[0], pieces[1], c, chords);
  const double in_middle = common_length(pieces[0], pieces[1], kMiddle, chords);
  column.missing = std::max(0.0, std::max(at_corners, in_middle) * column.rectangle.area() - column.lower);
  std::vector<Ball> a = balls_of(pieces[0]), b = balls_of(pieces[1]);
  column.a = std::move(a);
  column.b = std::move(b);
}

bool meets(const Ball& ball, const Rectangle& rectangle) { return greatest_half(ball, rectangle) > 0; }

}  // namespace medial_vk
