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
/// Squares lose digits: polish() is to follow.
Circles rough_circles(const SiteSet& sites, const std::array<Contact, 3>& contacts, Vec2 near);

/// One step of Newton's method on the three distances removes what squares have lost. It is taken where it helps. A
/// segment and its end leave nothing to remove, as the centre lies on the normal there: their distances differ by the
/// square of its way along the segment, so a step would move it by the root of a rounding.
void polish(const SiteSet& sites, const std::array<Contact, 3>& contacts, Circle& circle);

}  // namespace medial_vk::plane
