// What the calls that fit balls have in common: progress, requests to stop, and the steps after the search.
#pragma once

#include <stop_token>
#include <vector>

#include "medial_vk/extraction.h"
#include "medial_vk/progress.h"
#include "medial_vk/sphere_fits.h"
#include "sphere_fits/methods/sphere_set.h"

namespace medial_vk {

/// Progress and stop of the methods, which run on several threads. A cover by `count` begins with balls inside: both
/// stages are then parts of one share, which never falls. Keeps references.
SphereProgress progress_of_fit(const SphereFitOptions& options, const StageProgress& progress,
                               const std::stop_token& stop);

/// An extractor that a request to `stop` reaches, too: the methods have a source of stops of their own. Keeps
/// references.
Extractor stopped_by(const Extractor& extractor, const std::stop_token& stop);

/// The sets of a search, the smallest first, with the proofs and measures of the last one. The aim of the options is
/// the one that they were chosen by. Errors: kInternal if balls violate the contract, those of the measures. Throws
/// std::bad_alloc.
Result<SphereFit> finish_fit(const Solid& solid, std::vector<SphereSet> sets, const SphereFitOptions& options,
                             const SphereProgress& progress);

}  // namespace medial_vk
