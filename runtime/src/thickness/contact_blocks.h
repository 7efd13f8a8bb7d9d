// Contacts in float, eight at a time: which one of many is likely to bound balls best. What it shows is then computed
// in double precision from the contact itself (contact_bounds.h), so that no proof depends on the rounding here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/eight_floats.h"
#include "thickness/contact_bounds.h"
#include "thickness/direction_cell.h"

namespace medial_vk {

/// Eight contacts q, relative to the point p, in a unit of length L. A place without a contact says nothing.
struct alignas(32) EightContacts {
  using Eight = std::array<float, 8>;
  static constexpr std::size_t kWidth = 8;
  static constexpr float kFar = 1e30f;

  std::array<Eight, 3> at = {};                                      ///< q / L
  Eight squared = {kFar, kFar, kFar, kFar, kFar, kFar, kFar, kFar};  ///< |q|^2 / L^2
  Eight share = {};  ///< Times u.q / L - slack / L, it is L over the reach in the direction u (reach_by()).
  std::array<std::uint32_t, 8> number = {};
};

/// A part of the contacts in a row of blocks.
struct ContactRange {
  std::span<const EightContacts> blocks;
  std::size_t skipped = 0;  ///< Of the first block; less than 8.
};

/// In which unit contacts are written, and for which slack.
class ContactScale {
 public:
  ContactScale() = default;
  ContactScale(double unit, const Slack& slack) : inverse_(1 / unit), slack_(slack.distance / unit) {}

  void write(const Contact& contact, std::uint32_t number, EightContacts& block, std::size_t place) const {
    const double squared = contact.squared * inverse_ * inverse_, beyond = squared - slack_ * slack_;
    for (std::size_t axis = 0; axis < 3; ++axis) block.at[axis][place] = length(contact.at[axis]);
    block.squared[place] = static_cast<float>(squared);
    block.share[place] = beyond > 0 ? static_cast<float>(2 / beyond) : 0;
    block.number[place] = number;
  }
  float slack() const { return static_cast<float>(slack_); }
  float length(double x) const { return static_cast<float>(x * inverse_); }
  /// L over a reach, which may be infinite.
  float share(double reach) const { return static_cast<float>(1 / (reach * inverse_)); }

 private:
  double inverse_ = 1, slack_ = 0;  // 1 / L; over L
};

/// The number of the contact with the least reach in a direction, if that is less than `reach`; else kNoContact.
constexpr std::uint32_t kNoContact = 0xffffffffu;
std::uint32_t least_reach(const ContactScale& scale, const ContactRange& range, const Point& direction, double reach);
/// The number of the contact nearest to m; kNoContact if there is none.
std::uint32_t nearest_contact(const ContactScale& scale, const ContactRange& range, const Point& m);

/// The number of the contact with the least reach in a cell, if that is less than `reach`. Appends to `most` the
/// products of all contacts with the most parallel corner, times their shares: a contact q bounds a ball in a part of
/// the cell around s u, with s at most the reach, only if |q|^2 <= 2 s u.q.
std::uint32_t least_reach(const ContactScale& scale, const ContactRange& range, const DirectionCell& cell, double reach,
                          std::vector<EightContacts::Eight>& most);

/// Appends to `places` a bit for each of eight values that is at least a bound, which is positive.
void find_above(std::span<const EightContacts::Eight> values, float least, std::vector<std::uint8_t>& places);

/// Of eight contacts: distances from p, over L, at which the points in all corners of a cell, or on a ray, are within a
/// radius of one.
struct alignas(32) EightIntervals {
  EightContacts::Eight lower, upper;
  std::array<std::uint32_t, 8> number;
};

class NearIntervals {
 public:
  void measure(const ContactScale& scale, const ContactRange& range, const DirectionCell& cell, double radius);
  void measure(const ContactScale& scale, const ContactRange& range, const Point& direction, double radius);
  /// The number of the contact whose interval holds the distance `from` and ends last; kNoContact if none ends beyond.
  std::uint32_t farthest(double from) const;

 private:
  ContactScale scale_;
  std::vector<EightIntervals> intervals_;
};

}  // namespace medial_vk
