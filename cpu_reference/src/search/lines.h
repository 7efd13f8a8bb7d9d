// Aimed lines: lines across the possible positions of the medial surface in a cell (docs/theory.md, "Aimed lines").
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "dismissal/contacts.h"
#include "dismissal/pairs.h"
#include "geometry/box.h"

namespace medial_vk::reference {

struct Line {
  Eigen::Vector3d base;       // a point of the line, from the centre of the box
  Eigen::Vector3d direction;  // unit
};

/// The lines to be tried in a box, best first. `contacts` are those of the box, `pairs` its salient pairs; contacts tie
/// if their distances differ by less than `epsilon`.
std::vector<Line> aimed_lines(const Tree& tree, const Box& box, double epsilon, const Closest& nearest,
                              std::span<const Contact> contacts, std::span<const CarrierPair> pairs);

}  // namespace medial_vk::reference
