// Volume against number of sheets (Figures 6-2 and 6-3) as a table and as a drawing.
#pragma once

#include <string>

#include "medial_vk/sheets.h"
#include "medial_vk/significance.h"

namespace medial_vk {

/// The curves of both orders.
struct VolumeCurves {
  SheetRemoval by_significance;
  SheetRemoval keeping_topology;
};

/// One line per number of sheets, largest first: `order,sheets,volume,removed`: "significance" or "topology"; the
/// number of sheets; their share of the volume; the next sheet to be removed, or nothing.
std::string encode_curve_csv(const VolumeCurves& curves);
/// The curves as a drawing.
std::string encode_curve_svg(const VolumeCurves& curves);

}  // namespace medial_vk
