// Advice where balls inside leave much of a solid uncovered, from the numbers of the fit.
#pragma once

#include <optional>

#include "output/fit_reports/fits_record.h"

namespace medial_vk {

/// The share of the volume beyond which there is advice.
inline constexpr double kAdvisedShare = 0.25;

/// For balls of the contract; none if it is not inside, if less is uncovered, or where that is not known. Without
/// another fit: the time of one measurement of a union.
std::optional<FitAdvice> advise(const FittedSolid& solid, SphereContract contract);

}  // namespace medial_vk
