// The spokes of a ball from the shape of its sheet and the gradient of the radius along it.
#pragma once

#include <vector>

#include "curvature/sheet_links.h"

namespace medial_vk {

/// The sheet at a ball, by polynomials for its height over a plane and for the squared radius.
struct SheetFit {
  bool is_known = false;
  bool is_cut = false;               ///< Over more than a third of a turn, the outer half of the window has no ball.
  std::array<Point, 2> spokes = {};  ///< Unit vectors.
  std::array<Point, 2> tips = {};
};

/// Of the balls of `members` within `radius` of the ball that are kept. Not known where they are too few or too nearly
/// in a line, and where the gradient of the radius is not below 1, so that no sphere touches.
SheetFit fit_sheet(const SheetLinks& links, std::uint32_t ball, std::span<const SheetWindow::Member> members,
                   double radius, std::span<const std::uint8_t> is_kept);

}  // namespace medial_vk
