// Affine maps of the plane, as SVG writes them.
#pragma once

#include <string_view>

#include "medial_vk/plane_shape.h"

namespace medial_vk {

/// (x, y) goes to (a x + c y + e, b x + d y + f).
struct SvgMatrix {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  PlanePoint operator*(const PlanePoint& p) const { return {a * p[0] + c * p[1] + e, b * p[0] + d * p[1] + f}; }
  /// Of a direction: without the shift.
  PlanePoint turn(const PlanePoint& p) const { return {a * p[0] + c * p[1], b * p[0] + d * p[1]}; }
};

/// First `inner`, then `outer`.
SvgMatrix operator*(const SvgMatrix& outer, const SvgMatrix& inner);

/// The value of an attribute or a property `transform`: any number of matrix, translate, translateX, translateY, scale,
/// scaleX, scaleY, rotate, skewX, skewY and skew, with the units px, deg, grad, rad and turn. Throws SvgFault.
SvgMatrix parse_svg_transform(std::string_view text);

}  // namespace medial_vk
