// Measures of a set of balls as text, JSON, SVG and CSV.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "medial_vk/sphere_measures.h"

namespace medial_vk {

/// For the report: one key per measure, except for the bins of the diagrams; see docs/report.md.
nlohmann::ordered_json measures_json(const SphereMeasures& measures);
/// For readers: one line per measure, lengths also in percent of the diagonal.
std::string measures_text(const SphereMeasures& measures);
/// Both histograms, one above the other (Figure 8-2).
std::string encode_histograms_svg(const SphereMeasures& measures);
/// Both histograms as a table: `surface,lower,upper,share`.
std::string encode_histograms_csv(const SphereMeasures& measures);

}  // namespace medial_vk
