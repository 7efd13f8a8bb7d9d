#include "any_boundary/cell_block.h"

#include "base/point_ops.h"

namespace medial_vk::any_boundary {
namespace {

constexpr std::uint32_t kMask = (1u << CellBlock::kDepths) - 1;

}  // namespace

void CellBlock::begin(const CellGrid& grid, int depth, std::span<const std::uint64_t> codes,
                      const BoundaryQueries& queries) {
  constexpr std::size_t kPlaces = std::size_t{kWidth} * kWidth * kWidth;
  codes_ = codes;
  side_ = grid.side(depth);
  places_.resize(codes.size());
  inside_.resize(codes.size());
  points_.resize(kPlaces);
  nearest_.resize(kPlaces);
  is_known_.assign(kPlaces, 0);
  wanted_.clear();
  std::vector<Point> centres;
  centres.reserve(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    const CellIndex cell = cell_of_code(codes[i]);
    places_[i] = ((cell[2] & kMask) + kSampleReach) * kWidth * kWidth + ((cell[1] & kMask) + kSampleReach) * kWidth +
                 (cell[0] & kMask) + kSampleReach;
    centres.push_back(grid.centre(codes[i], depth));
    points_[places_[i]] = centres.back();
    is_known_[places_[i]] = 1;
    wanted_.push_back(places_[i]);
  }
  queries.contains(centres, inside_);
  query(queries);
}

void CellBlock::query_samples(std::span<const std::uint8_t> is_wanted, const BoundaryQueries& queries) {
  wanted_.clear();
  for (std::size_t i = 0; i < codes_.size(); ++i) {
    if (is_wanted[i] == 0) continue;
    for (std::size_t s = 0; s < kSamples; ++s) {
      const std::uint32_t at = place_of_sample(i, s);
      if (is_known_[at] != 0) continue;
      is_known_[at] = 1;
      points_[at] = sample(i, s);
      wanted_.push_back(at);
    }
  }
  query(queries);
}

void CellBlock::contacts(std::size_t cell, std::span<Point, kSamples> contacts) const {
  for (std::size_t s = 0; s < kSamples; ++s) contacts[s] = nearest_[place_of_sample(cell, s)];
}

Point CellBlock::sample(std::size_t cell, std::size_t sample) const {
  const auto& [x, y, z] = sample_offsets()[sample];
  return centre(cell) + side_ * Point{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

std::uint32_t CellBlock::place_of_sample(std::size_t cell, std::size_t sample) const {
  const auto& [x, y, z] = sample_offsets()[sample];
  return static_cast<std::uint32_t>(static_cast<int>(places_[cell]) + (z * kWidth + y) * kWidth + x);
}

void CellBlock::query(const BoundaryQueries& queries) {
  questions_.clear();
  questions_.reserve(wanted_.size());
  for (const std::uint32_t at : wanted_) questions_.push_back(points_[at]);
  answers_.resize(wanted_.size());
  queries.nearest(questions_, answers_);
  for (std::size_t i = 0; i < wanted_.size(); ++i) nearest_[wanted_[i]] = answers_[i];
}

}  // namespace medial_vk::any_boundary
