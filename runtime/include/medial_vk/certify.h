// The certificate in double precision (contract: every output ball satisfies it). The device finds balls in float;
// this makes their radii exact, and drops, with a count, any ball that does not pass.
#pragma once

#include <cstdint>

#include "medial_vk/bvh.h"
#include "medial_vk/extraction.h"

namespace medial_vk {

struct CertifyReport {
  std::uint64_t passed = 0;
  std::uint64_t rejected = 0;  ///< Dropped, as nothing on their sheet beside them passed: undecided voxels.
};

/// Recomputes radius and spoke a exactly at each centre as it will be written, rounds the radius down by a derived
/// bound, tests growth (Lemma 2.3), the tip of spoke b (Lemma 2.4), thresholds, and that the voxel is as stated and has
/// no other sphere (of several the first stays). Precondition: spheres in voxel order, as extraction gives them.
/// Threads: 0 for all.
CertifyReport certify_spheres(const Bvh& bvh, const ExtractionParameters& parameters, double longest_side,
                              Extraction& extraction, unsigned threads = 0);

}  // namespace medial_vk
