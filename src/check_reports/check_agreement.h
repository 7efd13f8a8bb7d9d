// Two extractions of one mesh against each other: the device's and that of the CPU reference.
#pragma once

#include "check_reports/check_report.h"
#include "medial_vk/certify.h"
#include "medial_vk/extraction.h"

namespace medial_vk {

/// Tests that both have the same grid, and a point in the same voxels as far as the proofs require it. Dismissal is
/// proved on both sides: of the voxels with a firm point (one whose object angle and whose distance from the faces of
/// its voxel do not depend on rounding) the other side may lack no more than it has undecided voxels, and searches
/// in another order explain a few at most. Precondition: mode certified, with `options` for both.
CheckReport check_agreement(const CertifiedExtraction& device, const Extraction& reference,
                            const ExtractionOptions& options);

}  // namespace medial_vk
