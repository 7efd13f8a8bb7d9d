#include "hull_fits/search/coverage_lines.h"

#include <algorithm>
#include <cmath>

#include "base/point_ops.h"

namespace medial_vk {
namespace {

/// The golden ratio: multiples of it have fractional parts that are spread evenly.
constexpr double kGolden = 0.6180339887498949;

}  // namespace

double CoverageLines::Lattice::first_u(std::size_t row, double shift) const {
  const double turns = kGolden * static_cast<double>(row) + shift;
  return lower_u + (turns - std::floor(turns)) * step_u;
}

CoverageLines::CoverageLines(const Point& lower, const Point& upper, std::size_t lines, std::uint64_t seed)
    : shift_(kGolden * kGolden * static_cast<double>(seed)) {
  const Point size = upper - lower;
  const double areas = size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  const double step = std::sqrt(areas / static_cast<double>(lines));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Lattice& lattice = lattices_[axis];
    lattice.columns = static_cast<std::size_t>(std::max(1.0, std::round(size[u] / step)));
    lattice.rows = static_cast<std::size_t>(std::max(1.0, std::round(size[v] / step)));
    lattice.lower_u = lower[u];
    lattice.lower_v = lower[v];
    lattice.step_u = size[u] / static_cast<double>(lattice.columns);
    lattice.step_v = size[v] / static_cast<double>(lattice.rows);
    lattice.share = lattice.step_u * lattice.step_v / 3;
    lattice.lines.resize(lattice.columns * lattice.rows);
  }
}

/// Calls visit(axis, index of the line, chord) for all lines that meet the hull.
template <class Visit>
void CoverageLines::for_each_line(const BallHull& hull, const Visit& visit) const {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Lattice& lattice = lattices_[axis];
    const HullChords chords(hull, axis);
    const Chord rows = chords.rows();
    const double first = std::ceil((rows.begin - lattice.lower_v) / lattice.step_v - 0.5);
    for (auto row = static_cast<std::size_t>(std::max(first, 0.0)); row < lattice.rows; ++row) {
      const double v = lattice.v(row);
      if (v > rows.end) break;
      const Chord range = chords.row(v);
      if (range.is_empty()) continue;
      const double first_u = lattice.first_u(row, shift_);
      const double before = std::ceil((range.begin - first_u) / lattice.step_u);
      for (auto column = static_cast<std::size_t>(std::max(before, 0.0)); column < lattice.columns; ++column) {
        const double u = first_u + static_cast<double>(column) * lattice.step_u;
        if (u > range.end) break;
        const Chord chord = chords.at(u, v);
        if (!chord.is_empty()) visit(axis, row * lattice.columns + column, chord);
      }
    }
  }
}

double CoverageLines::gain(const BallHull& hull, std::size_t except) const {
  double sum = 0;
  for_each_line(hull, [&](std::size_t axis, std::size_t line, const Chord& chord) {
    double free = chord.end - chord.begin;
    double reached = chord.begin;
    for (const Piece& piece : lattices_[axis].lines[line]) {
      if (piece.begin >= chord.end) break;
      if (piece.hull == except) continue;
      const double begin = std::max(reached, piece.begin), end = std::min(chord.end, piece.end);
      if (!(end > begin)) continue;
      free -= end - begin;
      reached = end;
    }
    sum += lattices_[axis].share * free;
  });
  return sum;
}

void CoverageLines::insert(const BallHull& hull, std::uint32_t number) {
  for_each_line(hull, [&](std::size_t axis, std::size_t index, const Chord& chord) {
    Line& line = lattices_[axis].lines[index];
    const Piece piece = {chord.begin, chord.end, number};
    const auto before = [](const Piece& a, const Piece& b) {
      return a.begin != b.begin ? a.begin < b.begin : a.hull < b.hull;
    };
    line.insert(std::upper_bound(line.begin(), line.end(), piece, before), piece);
  });
}

void CoverageLines::erase(const BallHull& hull, std::uint32_t number) {
  for_each_line(hull, [&](std::size_t axis, std::size_t index, const Chord&) {
    std::erase_if(lattices_[axis].lines[index], [&](const Piece& piece) { return piece.hull == number; });
  });
}

void CoverageLines::add(const BallHull& hull) {
  insert(hull, static_cast<std::uint32_t>(hulls_.size()));
  hulls_.push_back(hull);
}

void CoverageLines::replace(std::size_t i, const BallHull& hull) {
  erase(hulls_[i], static_cast<std::uint32_t>(i));
  insert(hull, static_cast<std::uint32_t>(i));
  hulls_[i] = hull;
}

void CoverageLines::remove_last() {
  erase(hulls_.back(), static_cast<std::uint32_t>(hulls_.size() - 1));
  hulls_.pop_back();
}

double CoverageLines::covered() const {
  double sum = 0;
  for (const Lattice& lattice : lattices_) {
    for (const Line& line : lattice.lines) {
      double reached = -HUGE_VAL;
      for (const Piece& piece : line) {
        if (!(piece.end > reached)) continue;
        sum += lattice.share * (piece.end - std::max(reached, piece.begin));
        reached = piece.end;
      }
    }
  }
  return sum;
}

}  // namespace medial_vk
