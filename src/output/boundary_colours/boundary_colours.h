// Colours of the vertices of a boundary by what was measured there, with their legend, for pictures and glTF.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "boundary_fields/boundary_fields.h"

namespace medial_vk {

/// All colours are encoded sRGB values, 0 to 1.
struct BoundaryColours {
  std::vector<Eigen::Vector3f> of_vertices;  ///< Grey where the quantity is not known.
  std::string title;
  /// Of the bar from `least` to `greatest`, evenly spaced; empty: there are swatches.
  std::vector<Eigen::Vector3f> bar;
  std::string least, greatest;
  std::vector<std::pair<Eigen::Vector3f, std::string>> swatches;
};

/// Whether `fields` hold what the colour shows.
bool can_colour(const BoundaryFields& fields, BoundaryColour by);

/// `longest_side` is that of the mesh: the unit in which curvatures count as small. Precondition: can_colour().
BoundaryColours colour_boundary(const BoundaryFields& fields, BoundaryColour by, double longest_side);

/// The colour of a shape: kappa_1 >= kappa_2, in units of 1 / length.
Eigen::Vector3f colour_of_shape(double kappa_1, double kappa_2, double length);

}  // namespace medial_vk
