// Pairs of contacts that a ball with a large object angle may have (docs/theory.md, "Least wall").
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/point_ops.h"
#include "least_wall/spoke_groups.h"
#include "medial_vk/sphere_measures.h"

namespace medial_vk {

/// Bounds are widened by this share for the rounding of some ten operations.
constexpr double kBoundShare = 0x1p-44;

/// What is known of the spokes of balls around some centres, within h of a point c, that touch inside a triangle or on
/// an edge.
struct PossibleContact {
  SpokeCone by_position;  ///< The directions from the centres to the triangle or edge.
  SpokeCone by_normals;   ///< That of the triangle, or those of the triangles that may meet at the edge.
  double distance = 0;    ///< Of the triangle or edge from c, at least.
  /// Of the triangle or edge, relative to c; an edge has one of them twice.
  std::array<Point, 3> corners = {};
};

/// A triangle for spokes_by_normals().
struct FacingTriangle {
  std::array<Point, 3> corners;
  SpokeCone normal;  ///< Towards the side of contacts' spokes; an axis of zero: any.
};

/// The least radius of a ball around m, |m - c| <= h, with an object angle of theta or more, and contacts at distances
/// from c whose squares have the mean d^2, or a greater one.
double least_radius_around(double d, double h, double theta);

/// By triangle: a cap that holds the spokes of all contacts on it, whichever of the other triangles meet it there.
/// `rounding`: of heights of corners over planes. `meeting` is memory for it.
void spokes_by_normals(std::span<const FacingTriangle> triangles, double rounding,
                       std::vector<const SpokeCone*>& meeting, std::vector<SpokeCone>& caps);

/// Of a ball with both contacts, at least, by the heights of their corners along some directions. `rounding`: of these.
double least_radius_by_heights(const PossibleContact& a, const PossibleContact& b, double rounding);

/// A bound of the radius of balls with an object angle of theta or more and two of the contacts, if it is above
/// `known`, or else `known`; infinite if no two are possible. Contacts that are not possible are removed. `rounding`:
/// of heights of corners.
double least_radius_of_pairs(std::vector<PossibleContact>& contacts, double h, double theta, double known,
                             double rounding);

}  // namespace medial_vk
