#include "proximity/penetration/column.h"

#include <algorithm>
#include <cmath>

namespace medial_vk {
namespace {

constexpr double kUnit = 0x1p-53;
constexpr std::size_t kCorners = 4;

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

/// A ball whose projection holds the rectangle, with its chords over the corners. Within the rectangle the upper end is
/// a concave function, and the lower one convex.
struct Pillar {
  const Ball* ball = nullptr;
  std::array<Chord, kCorners> chords;
  std::uint32_t group = 0;

  double sum_of_uppers() const { return chords[0].upper + chords[1].upper + (chords[2].upper + chords[3].upper); }
  double sum_of_lowers() const { return chords[0].lower + chords[1].lower + (chords[2].lower + chords[3].lower); }
};

/// Over the whole rectangle the two overlap: the least upper end less the greatest lower one is concave, so it is
/// nowhere less than at the worst corner.
bool overlap(const Pillar& p, const Pillar& q) {
  for (std::size_t c = 0; c < kCorners; ++c) {
    if (p.chords[c].lower > q.chords[c].upper || q.chords[c].lower > p.chords[c].upper) return false;
  }
  return true;
}

std::array<double, 2> corner(const Rectangle& rectangle, std::size_t c) {
  return {(c & 1) != 0 ? rectangle.to[0] : rectangle.from[0], (c & 2) != 0 ? rectangle.to[1] : rectangle.from[1]};
}

std::vector<Pillar> pillars_of(std::span<const Ball> balls, const Rectangle& rectangle) {
  std::vector<Pillar> pillars;
  for (const Ball& ball : balls) {
    Pillar pillar{&ball, {}, 0};
    bool holds = true;
    for (std::size_t c = 0; c < kCorners && holds; ++c) {
      const auto [x, y] = corner(rectangle, c);
      pillar.chords[c] = chord_of(ball, x, y);
      holds = pillar.chords[c].exists();
    }
    if (holds) pillars.push_back(pillar);
  }
  return pillars;
}

/// Over every point of the rectangle the union of the chords of a group is one segment, from no higher than those of
/// the pillar `lowest` to no lower than those of `highest`.
struct Group {
  const Pillar* lowest;
  const Pillar* highest;
};

std::vector<Group> groups_of(std::vector<Pillar>& pillars) {
  std::vector<Group> groups;
  std::vector<std::uint32_t> open;
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  for (Pillar& pillar : pillars) pillar.group = kNone;
  for (std::uint32_t first = 0; first < pillars.size(); ++first) {
    if (pillars[first].group != kNone) continue;
    Group group{&pillars[first], &pillars[first]};
    pillars[first].group = static_cast<std::uint32_t>(groups.size());
    open.assign(1, first);
    while (!open.empty()) {
      const Pillar& pillar = pillars[open.back()];
      open.pop_back();
      if (pillar.sum_of_lowers() < group.lowest->sum_of_lowers()) group.lowest = &pillar;
      if (pillar.sum_of_uppers() > group.highest->sum_of_uppers()) group.highest = &pillar;
      for (std::uint32_t other = 0; other < pillars.size(); ++other) {
        if (pillars[other].group != kNone || !overlap(pillar, pillars[other])) continue;
        pillars[other].group = pillar.group;
        open.push_back(other);
      }
    }
    groups.push_back(group);
  }
  return groups;
}

/// A part of the common volume: over each point of the rectangle from the greater of two lower ends to the lesser of
/// two upper ones.
struct Part {
  double mean = 0;          ///< Of its length at the corners.
  double from = 0, to = 0;  ///< It lies between.
};

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

/// The length is concave over the rectangle, so its integral is at least the mean at the corners times the area.
Part common_part(const Group& a, const Group& b, const Rectangle& rectangle) {
  Part part;
  double size = 0;
  for (std::size_t c = 0; c < kCorners; ++c) {
    const double length = std::min(a.highest->chords[c].upper, b.highest->chords[c].upper) -
                          std::max(a.lowest->chords[c].lower, b.lowest->chords[c].lower);
    part.mean += 0.25 * length;
    size += std::fabs(length);
  }
  part.mean -= 8 * kUnit * size;  // lengths may have both signs
  const auto top = [&](const Pillar& p) { return p.ball->centre[2] + greatest_half(*p.ball, rectangle); };
  const auto bottom = [&](const Pillar& p) { return p.ball->centre[2] - greatest_half(*p.ball, rectangle); };
  part.from = std::max(bottom(*a.lowest), bottom(*b.lowest));
  part.to = std::min(top(*a.highest), top(*b.highest));
  const double slack = 4 * kUnit * (std::fabs(part.from) + std::fabs(part.to));
  part.from -= slack;
  part.to += slack;
  return part;
}

/// The lengths of parts of which no two have a point in common, the longest first.
double sum_of_disjoint(std::vector<Part>& parts) {
  std::ranges::sort(parts, [](const Part& s, const Part& t) { return s.mean > t.mean; });
  double sum = 0;
  std::vector<Part> taken;
  for (const Part& part : parts) {
    const auto is_apart = [&](const Part& other) { return other.to < part.from || part.to < other.from; };
    if (!std::ranges::all_of(taken, is_apart)) continue;
    taken.push_back(part);
    sum += part.mean;
  }
  sum *= 1 - 0x1p-53 * static_cast<double>(taken.size() + 1);  // the roundings of the sum
  return sum;
}

/// The length that both unions have in common on the line through (x, y), up to rounding.
double common_length(std::span<const Ball> a, std::span<const Ball> b, double x, double y,
                     std::array<std::vector<Chord>, 2>& scratch) {
  for (std::size_t set = 0; set < 2; ++set) {
    std::vector<Chord>& chords = scratch[set];
    chords.clear();
    for (const Ball& ball : set == 0 ? a : b) {
      const Chord chord = chord_of(ball, x, y);
      if (chord.exists()) chords.push_back(chord);
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

}  // namespace

bool meets(const Ball& ball, const Rectangle& rectangle) { return greatest_half(ball, rectangle) > 0; }

ColumnVolume measure_column(std::span<const Ball> a, std::span<const Ball> b, const Rectangle& rectangle) {
  std::vector<Pillar> pillars_a = pillars_of(a, rectangle), pillars_b = pillars_of(b, rectangle);
  const std::vector<Group> groups_a = groups_of(pillars_a), groups_b = groups_of(pillars_b);
  std::vector<Part> parts;
  for (const Group& of_a : groups_a) {
    for (const Group& of_b : groups_b) {
      const Part part = common_part(of_a, of_b, rectangle);
      if (part.mean > 0) parts.push_back(part);
    }
  }
  ColumnVolume volume;
  volume.lower = sum_of_disjoint(parts) * rectangle.area();
  std::array<std::vector<Chord>, 2> scratch;
  double at_corners = 0;
  for (std::size_t c = 0; c < kCorners; ++c) {
    const auto [x, y] = corner(rectangle, c);
    at_corners += 0.25 * common_length(a, b, x, y, scratch);
  }
  const double in_middle = common_length(a, b, 0.5 * (rectangle.from[0] + rectangle.to[0]),
                                         0.5 * (rectangle.from[1] + rectangle.to[1]), scratch);
  volume.missing = std::max(0.0, std::max(at_corners, in_middle) * rectangle.area() - volume.lower);
  return volume;
}

}  // namespace medial_vk
