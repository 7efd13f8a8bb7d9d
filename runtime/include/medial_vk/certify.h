// The certificate in double precision, which every output ball satisfies. The device finds balls in float; the
// certification makes their radii exact, and drops and counts the balls that do not pass.
#pragma once

#include <cstdint>
#include <stop_token>

#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

class Context;

/// The numbers of spheres by the outcome of their certificate.
struct CertificateReport {
  std::uint64_t passed = 0;
  std::uint64_t rejected = 0;  ///< Dropped, since neither the ball nor a point beside it on its sheet passed.
};

/// Recomputes radius and spoke a exactly at each centre as written to the output, rounds the radius down by a derived
/// bound, and tests growth (Lemma 2.3), the tip of spoke b (Lemma 2.4), the thresholds, and the voxel: the centre lies
/// in the stated voxel, which has no other sphere (of several, the first is kept). Spheres that fail are dropped; in
/// mode certified their voxels are added to the undecided ones. The extraction proves sides. Preconditions: its
/// `options`, and its order of spheres. Errors: kUsage (it is of the other side); kOutOfMemory (it is then undefined).
Result<CertificateReport> certify_spheres(const IndexedMesh& mesh, const ExtractionOptions& options,
                                          Extraction& extraction);

/// The result of extract_and_certify(): every sphere satisfies the certificate.
struct CertifiedExtraction {
  Extraction extraction;
  CertificateReport certificate;
};

/// Finds medial spheres and certifies them. Does not throw. Errors: those of the extractor; kOutOfMemory; kInterrupted.
Result<CertifiedExtraction> extract_and_certify(const IndexedMesh& mesh, const ExtractionOptions& options,
                                                const Extractor& extractor, const StageProgress& progress = {},
                                                const std::stop_token& stop = {});

/// The same on the device of `context`.
Result<CertifiedExtraction> extract_and_certify(const IndexedMesh& mesh, const ExtractionOptions& options,
                                                Context& context, const StageProgress& progress = {},
                                                const std::stop_token& stop = {});

}  // namespace medial_vk
