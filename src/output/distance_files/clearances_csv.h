// Least distances of the links of a robot as a table.
#pragma once

#include <span>
#include <string>

#include "medial_vk/proximity.h"

namespace medial_vk {

/// An interval that contains the least distance of a configuration.
struct Clearance {
  double lower = 0, upper = 0;
  std::string first, second;  ///< The links, or the file of a scene, that give the upper end, or else the lower one.

  Collision collision() const {
    return lower > 0 ? Collision::kFree : upper == 0 ? Collision::kHit : Collision::kUndecided;
  }
};

/// A line per configuration, after a line of names: configuration (from 1), state, lower, upper, first, second. Numbers
/// read back as the same doubles; an infinite one is "inf". A name with a comma, quote or line end is in quotes.
std::string encode_clearances_csv(std::span<const Clearance> clearances);

}  // namespace medial_vk
