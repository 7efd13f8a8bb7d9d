// The points at equal distance from three sites: centres of circles that touch all of them (docs/theory.md, "In the
// plane").
#pragma once

#include <array>

#include "plane/sites/bisector.h"

namespace medial_vk::plane {

struct Circle {
  Vec2 centre;
  double radius = 0;
};

struct Circles {
  std::array<Circle, 2> circles = {};
  int count = 0;
};

/// Of the lines of segments, each on its side, and of points. `near` is where the circles are wanted: coordinates are
/// taken from there, so that small figures keep their digits. Circles of a radius that is not positive are left out.
Circles circles_through(const SiteSet& sites, const std::array<Contact, 3>& contacts, Vec2 near);

}  // namespace medial_vk::plane
