// Volume against number of sheets (Figures 6-2 and 6-3) as a table and as a drawing.
#pragma once

#include <string>

#include "medial_vk/sheets.h"

namespace medial_vk {

/// Both orders.
struct VolumeCurves {
  SheetRemoval by_significance;
  SheetRemoval keeping_topology;
};

/// One line per number of sheets, most first: `order,sheets,volume,removed`: "significance" or "topology"; how many are
/// there; their share of the volume; the sheet that goes next, or nothing.
std::string encode_curve_csv(const VolumeCurves& curves);
/// The same as a drawing.
std::string encode_curve_svg(const VolumeCurves& curves);

}  // namespace medial_vk
