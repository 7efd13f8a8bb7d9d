// The weights of joints that make a point follow given places.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace medial_vk {

/// Weights w, not negative and with sum 1, for which the sum over all rows (three for each frame) of (offsets * w)^2 is
/// least. Column j of `offsets` leads from the wanted places to where joint j alone would bring the point. With at most
/// four columns every subset of joints is tried, so that the minimum is found.
Eigen::VectorXd blend_weights(const Eigen::MatrixXd& offsets);

}  // namespace medial_vk
