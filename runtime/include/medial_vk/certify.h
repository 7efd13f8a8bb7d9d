// The certificate in double precision (contract: every output ball satisfies it). The device finds balls in float;
// this makes their radii exact, and drops, with a count, any ball that does not pass.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"

namespace medial_vk {

struct CertificateReport {
  std::uint64_t passed = 0;
  std::uint64_t rejected = 0;  ///< Dropped: neither they nor a point beside them on their sheet passed.
};

/// Recomputes radius and spoke a exactly at each centre as it will be written, rounds the radius down by a derived
/// bound, and tests growth (Lemma 2.3), the tip of spoke b (Lemma 2.4), thresholds, and that the voxel is as stated and
/// has no other sphere (of several the first stays). Spheres that fail are dropped; in mode certified their voxels are
/// added to the undecided ones. `options` are those of the extraction. Precondition: spheres in voxel order, as
/// extraction gives them. Throws std::bad_alloc.
CertificateReport certify_spheres(const IndexedMesh& mesh, const ExtractionOptions& options, Extraction& extraction);

/// What extract_and_certify() finds: every sphere has the certificate.
struct CertifiedExtraction {
  Extraction extraction;
  CertificateReport certificate;
  std::vector<StageTime> host_times;  ///< Seconds by the clock on the wall: "extract", "certify".
};

/// Finds medial spheres and certifies them. Does not throw. Errors: those of the extractor; kOutOfMemory; kInterrupted.
Result<CertifiedExtraction> extract_and_certify(const IndexedMesh& mesh, const ExtractionOptions& options,
                                                const Extractor& extractor, const StageProgress& progress = {},
                                                const std::stop_token& stop = {});

}  // namespace medial_vk
