#include "thickness/contact_blocks.h"

#include <algorithm>
#include <limits>

namespace medial_vk {
namespace {

using Eight = EightContacts::Eight;
using FloatPoint = std::array<float, 3>;

FloatPoint in_float(const Point& p) {
  return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
}

MEDIAL_VK_INLINE EightFloats product(const FloatPoint& a, const std::array<Eight, 3>& b) {
  return a[0] * load(b[0]) + a[1] * load(b[1]) + a[2] * load(b[2]);
}

MEDIAL_VK_INLINE EightInts numbers_of(const std::array<std::uint32_t, 8>& numbers) {
  EightInts ints;
  std::memcpy(&ints, numbers.data(), sizeof ints);
  return ints;
}

/// The greatest of values above a bound, and its number: in each place, and then of all.
class Greatest {
 public:
  MEDIAL_VK_INLINE explicit Greatest(float bound) : value_(EightFloats{} + bound), number_(EightInts{} - 1) {}

  MEDIAL_VK_INLINE void take(const EightFloats& value, const EightInts& number) {
    const EightInts is_greater = value > value_;
    value_ = select(is_greater, value, value_);
    number_ = (is_greater & number) | (~is_greater & number_);
  }
  MEDIAL_VK_INLINE std::uint32_t number() const {
    const Eight values = stored(value_);
    std::size_t best = 0;
    for (std::size_t k = 1; k < 8; ++k) best = values[k] > values[best] ? k : best;
    return static_cast<std::uint32_t>(number_[best]);
  }

 private:
  EightFloats value_;
  EightInts number_;
};

/// Of a direction. A direction without a contact ahead has a share of 0 or less.
struct MeasureReach {
  const ContactRange& range;
  FloatPoint direction;
  float slack, least_share;

  MEDIAL_VK_INLINE std::uint32_t operator()() const {
    Greatest greatest(least_share);
    for (const EightContacts& block : range.blocks) {
      greatest.take((product(direction, block.at) - slack) * load(block.share), numbers_of(block.number));
    }
    return greatest.number();
  }
};

/// The negative squared distance from m, without |m|^2.
struct MeasureSquares {
  const ContactRange& range;
  FloatPoint twice_m;

  MEDIAL_VK_INLINE std::uint32_t operator()() const {
    Greatest greatest(-0.5f * EightContacts::kFar);
    for (const EightContacts& block : range.blocks) {
      greatest.take(product(twice_m, block.at) - load(block.squared), numbers_of(block.number));
    }
    return greatest.number();
  }
};

struct MeasureCell {
  const ContactRange& range;
  std::array<FloatPoint, 3> corners;
  float slack, least_share;
  Eight* most;

  MEDIAL_VK_INLINE std::uint32_t operator()() const {
    Greatest greatest(least_share);
    for (std::size_t i = 0; i < range.blocks.size(); ++i) {
      const EightContacts& block = range.blocks[i];
      const EightFloats a = product(corners[0], block.at), b = product(corners[1], block.at);
      const EightFloats c = product(corners[2], block.at), share = load(block.share);
      EightFloats value = (lesser(lesser(a, b), c) - slack) * share;
      most[i] = stored(greater(greater(a, b), c) * share);
      if (i == 0) value = select(kPlaces >= static_cast<std::int32_t>(range.skipped), value, EightFloats{} - 1.0f);
      greatest.take(value, numbers_of(block.number));
    }
    return greatest.number();
  }

  static constexpr EightInts kPlaces = {0, 1, 2, 3, 4, 5, 6, 7};
};

/// The interval of each contact: |s u - q| <= radius for s = u.q -+ sqrt(radius^2 - |q|^2 + (u.q)^2).
template <std::size_t kCount>
struct MeasureIntervals {
  const ContactRange& range;
  std::array<FloatPoint, kCount> directions;
  float radius;
  EightIntervals* intervals;

  MEDIAL_VK_INLINE void operator()() const {
    const EightFloats zero = {}, infinite = zero + std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < range.blocks.size(); ++i) {
      const EightContacts& block = range.blocks[i];
      const EightFloats rest = radius * radius - load(block.squared);
      EightFloats low = zero, high = infinite;
      for (const FloatPoint& direction : directions) {
        const EightFloats along = product(direction, block.at), half_squared = rest + along * along;
        const EightFloats half = square_root(greater(half_squared, zero));
        low = greater(low, select(half_squared > zero, along - half, infinite));
        high = lesser(high, along + half);
      }
      intervals[i] = {stored(low), stored(high), block.number};
    }
  }
};

struct FindFarthest {
  std::span<const EightIntervals> intervals;
  float from;

  MEDIAL_VK_INLINE std::uint32_t operator()() const {
    const EightFloats nothing = EightFloats{} - 1.0f;
    Greatest greatest(from);
    for (const EightIntervals& eight : intervals) {
      greatest.take(select(load(eight.lower) <= from, load(eight.upper), nothing), numbers_of(eight.number));
    }
    return greatest.number();
  }
};

struct FindAbove {
  std::span<const Eight> values;
  float least;
  std::uint8_t* places;

  MEDIAL_VK_INLINE void operator()() const {
    for (std::size_t i = 0; i < values.size(); ++i) {
      places[i] = static_cast<std::uint8_t>(bits_of(load(values[i]) >= least));
    }
  }
};

std::array<FloatPoint, 3> corners_of(const DirectionCell& cell) {
  const FourDirections& all = cell.corners();  // the last two are equal
  std::array<FloatPoint, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = in_float({all[0][i], all[1][i], all[2][i]});
  return corners;
}

}  // namespace

std::uint32_t least_reach(const ContactScale& scale, const ContactRange& range, const Point& direction, double reach) {
  MeasureReach work = {range, in_float(direction), scale.slack(), scale.share(reach)};
  return run_on_this_processor(work);
}

std::uint32_t nearest_contact(const ContactScale& scale, const ContactRange& range, const Point& m) {
  MeasureSquares work = {range, {2 * scale.length(m[0]), 2 * scale.length(m[1]), 2 * scale.length(m[2])}};
  return run_on_this_processor(work);
}

std::uint32_t least_reach(const ContactScale& scale, const ContactRange& range, const DirectionCell& cell, double reach,
                          std::vector<Eight>& most) {
  const std::size_t before = most.size();
  most.resize(before + range.blocks.size());
  MeasureCell work = {range, corners_of(cell), scale.slack(), scale.share(reach), most.data() + before};
  return run_on_this_processor(work);
}

void find_above(std::span<const Eight> values, float least, std::vector<std::uint8_t>& places) {
  places.resize(values.size());
  FindAbove work = {values, std::max(least, std::numeric_limits<float>::min()), places.data()};
  run_on_this_processor(work);
}

void NearIntervals::measure(const ContactScale& scale, const ContactRange& range, const DirectionCell& cell,
                            double radius) {
  scale_ = scale;
  intervals_.resize(range.blocks.size());
  MeasureIntervals<3> work = {range, corners_of(cell), scale.length(radius), intervals_.data()};
  run_on_this_processor(work);
}

void NearIntervals::measure(const ContactScale& scale, const ContactRange& range, const Point& direction,
                            double radius) {
  scale_ = scale;
  intervals_.resize(range.blocks.size());
  MeasureIntervals<1> work = {range, {in_float(direction)}, scale.length(radius), intervals_.data()};
  run_on_this_processor(work);
}

std::uint32_t NearIntervals::farthest(double from) const {
  FindFarthest work = {intervals_, scale_.length(from)};
  return run_on_this_processor(work);
}

}  // namespace medial_vk
