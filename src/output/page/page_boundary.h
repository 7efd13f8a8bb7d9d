// What was measured on the boundary, as parts of the page: colours of vertices with their legends, and numbers.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "boundary_fields/boundary_fields.h"

namespace medial_vk::page {

/// The colours that the fields allow, with their legends, and the names of the fields, those of principal directions
/// apart; null without fields.
nlohmann::ordered_json boundary_json(const BoundaryFields& fields, double longest_side);

/// Appends the blocks that boundary_json() names: three bytes for each vertex and colour, a float for each number; for
/// a direction three integers of 16 bits, 0 where it is not known.
void write_boundary(std::string& page, const BoundaryFields& fields, double longest_side);

}  // namespace medial_vk::page
