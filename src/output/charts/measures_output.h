// Measures of a set of balls for reports, people and pictures.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "spheres/measures/measures.h"

namespace medial_vk {

/// For the report: everything but the pictures' bins has its own key; see docs/report.md.
nlohmann::ordered_json measures_json(const SphereMeasures& measures);
/// For people: one line each, lengths also in percent of the diagonal.
std::string measures_text(const SphereMeasures& measures);
/// Both histograms above each other (Figure 8-2).
std::string encode_histograms_svg(const SphereMeasures& measures);
/// The same as a table: `surface,lower,upper,share`.
std::string encode_histograms_csv(const SphereMeasures& measures);

}  // namespace medial_vk
