// How likely each ball of a set is to be the closest to another solid.
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"

namespace medial_vk::bench {

/// By equation 8.3 (S. Stolpner, "Medial Spheres for Shape Representation", 2011, Section 8.7.4): the share of each
/// ball in the area of the envelope after all radii have grown by `distance`, an estimate of the distance of the
/// solids. Sums to 1. Ends the program with a message where the union cannot be measured.
std::vector<double> likelihoods_of(std::span<const Ball> balls, double distance);

}  // namespace medial_vk::bench
