#include "thickness/contact_lists.h"

#include <cmath>
#include <limits>

#include "base/eight_floats.h"

namespace medial_vk {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Columns {
  const double *x, *y, *z, *squared;

  Columns(const ContactArrays& arrays, std::size_t first)
      : x(arrays.x.data() + first),
        y(arrays.y.data() + first),
        z(arrays.z.data() + first),
        squared(arrays.squared.data() + first) {}
};

MEDIAL_VK_INLINE double lesser_of(double a, double b) { return a < b ? a : b; }
MEDIAL_VK_INLINE double greater_of(double a, double b) { return a > b ? a : b; }

/// Products of each contact with the nearest to perpendicular and the most parallel of four directions, and the reach
/// of a cell by the contact alone.
struct MeasureContacts {
  const FourDirections& directions;
  Columns from;
  std::size_t count;
  const Slack& slack;
  double *least, *most, *reach;

  MEDIAL_VK_INLINE void operator()() const {
    for (std::size_t j = 0; j < count; ++j) {
      double low = kInfinite, high = -kInfinite;
      for (std::size_t i = 0; i < 4; ++i) {
        const double product =
            directions[0][i] * from.x[j] + directions[1][i] * from.y[j] + directions[2][i] * from.z[j];
        low = lesser_of(low, product);
        high = greater_of(high, product);
      }
      least[j] = low;
      most[j] = high;
      reach[j] = reach_by(from.squared[j], low, slack);
    }
  }
};

/// The reach along a ray by each contact.
struct MeasureReach {
  const Point& direction;
  Columns from;
  std::size_t count;
  const Slack& slack;
  double* reach;

  MEDIAL_VK_INLINE void operator()() const {
    for (std::size_t j = 0; j < count; ++j) {
      const double product = direction[0] * from.x[j] + direction[1] * from.y[j] + direction[2] * from.z[j];
      reach[j] = reach_by(from.squared[j], product, slack);
    }
  }
};

/// The squared distance of a point from each contact.
struct MeasureSquares {
  const Point& m;
  double squared;
  Columns from;
  std::size_t count;
  double* distances;

  MEDIAL_VK_INLINE void operator()() const {
    for (std::size_t j = 0; j < count; ++j) {
      const double product = m[0] * from.x[j] + m[1] * from.y[j] + m[2] * from.z[j];
      distances[j] = squared - 2 * product + from.squared[j];
    }
  }
};

/// The interval of each contact: |s u - q| <= radius for s = u.q -+ sqrt(radius^2 - |q|^2 + (u.q)^2).
struct MeasureIntervals {
  const FourDirections& directions;
  Columns from;
  std::size_t count;
  double radius;
  double *lower, *upper;

  MEDIAL_VK_INLINE void operator()() const {
    for (std::size_t j = 0; j < count; ++j) {
      const double rest = radius * radius * (1 - kSquareRounding) - from.squared[j] * (1 + kSquareRounding);
      double low = 0, high = kInfinite;
      for (std::size_t i = 0; i < 4; ++i) {
        const double product =
            directions[0][i] * from.x[j] + directions[1][i] * from.y[j] + directions[2][i] * from.z[j];
        const double half_squared = rest + product * product;
        const double half = std::sqrt(greater_of(half_squared, 0));
        low = greater_of(low, half_squared > 0 ? product - half : kInfinite);
        high = lesser_of(high, product + half);
      }
      lower[j] = low * kBoundRounding;
      upper[j] = high / kBoundRounding;
    }
  }
};

}  // namespace

void ContactArrays::resize(std::size_t size) {
  x.resize(size);
  y.resize(size);
  z.resize(size);
  squared.resize(size);
  number.resize(size);
}

void ContactLists::clear() {
  all_.resize(0);
  listed_.resize(0);
}

void ContactLists::add(const Contact& contact) {
  all_.x.push_back(contact.at[0]);
  all_.y.push_back(contact.at[1]);
  all_.z.push_back(contact.at[2]);
  all_.squared.push_back(contact.squared);
  all_.number.push_back(static_cast<std::uint32_t>(all_.number.size()));
}

ContactLists::Reach ContactLists::narrow(const DirectionCell& cell, const Slack& slack, double reach, List& list) {
  const std::size_t added = all_.size() - list.seen, end = listed_.size();
  least_.resize(list.count + added);
  most_.resize(list.count + added);
  reach_.resize(list.count + added);
  const auto measure = [&](const ContactArrays& from, std::size_t first, std::size_t count, std::size_t at) {
    MeasureContacts work = {cell.corners(),    Columns(from, first), count, slack, least_.data() + at,
                            most_.data() + at, reach_.data() + at};
    run_on_this_processor(work);
  };
  measure(listed_, list.first, list.count, 0);
  measure(all_, list.seen, added, list.count);
  listed_.resize(end + list.count + added);
  Reach found = {reach, kNone};
  std::size_t kept = end;
  const auto keep = [&](const ContactArrays& from, std::size_t first, std::size_t count, std::size_t at) {
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t i = first + j;
      listed_.x[kept] = from.x[i];
      listed_.y[kept] = from.y[i];
      listed_.z[kept] = from.z[i];
      listed_.squared[kept] = from.squared[i];
      listed_.number[kept] = from.number[i];
      if (reach_[at + j] < found.most) found = {reach_[at + j], from.number[i]};
      kept += from.squared[i] <= 2 * cell.bulge() * most_[at + j] * reach ? 1 : 0;
    }
  };
  keep(listed_, list.first, list.count, 0);
  keep(all_, list.seen, added, list.count);
  listed_.resize(kept);
  list = {static_cast<std::uint32_t>(end), static_cast<std::uint32_t>(kept - end), static_cast<std::uint32_t>(size())};
  return found;
}

ContactLists::Reach ContactLists::reach_along(const Point& direction, const Slack& slack, double reach) {
  return least_reach(all_, 0, size(), direction, slack, reach);
}

ContactLists::Reach ContactLists::reach_along(const Point& direction, const Slack& slack, double reach,
                                              const List& list) {
  return least_reach(listed_, list.first, list.count, direction, slack, reach);
}

ContactLists::Reach ContactLists::least_reach(const ContactArrays& from, std::size_t first, std::size_t count,
                                              const Point& direction, const Slack& slack, double reach) {
  reach_.resize(count);
  MeasureReach work = {direction, Columns(from, first), count, slack, reach_.data()};
  run_on_this_processor(work);
  Reach found = {reach, kNone};
  for (std::size_t j = 0; j < count; ++j) {
    if (reach_[j] < found.most) found = {reach_[j], from.number[first + j]};
  }
  return found;
}

double ContactLists::least_squared_distance(const Point& m) {
  reach_.resize(size());
  MeasureSquares work = {m, dot(m, m), Columns(all_, 0), size(), reach_.data()};
  run_on_this_processor(work);
  double least = kInfinite;
  for (std::size_t j = 0; j < size(); ++j) least = lesser_of(least, reach_[j]);
  return least;
}

void ContactLists::intervals_near(const FourDirections& directions, const List& list, double radius, double from,
                                  std::vector<Interval>& intervals) {
  least_.resize(list.count);
  most_.resize(list.count);
  MeasureIntervals work = {directions, Columns(listed_, list.first), list.count, radius, least_.data(), most_.data()};
  run_on_this_processor(work);
  intervals.clear();
  for (std::size_t j = 0; j < list.count; ++j) {
    if (least_[j] < most_[j] && most_[j] > from) {
      intervals.push_back({least_[j], most_[j], listed_.number[list.first + j]});
    }
  }
}

}  // namespace medial_vk
