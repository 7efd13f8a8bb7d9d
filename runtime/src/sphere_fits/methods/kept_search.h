// The search for balls inside one solid, kept for several calls.
#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>
#include <vector>

#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"
#include "medial_vk/sphere_fits.h"

namespace medial_vk {

/// Method best: the curve of measure_coverage_curve() and the balls of fit_spheres() with contract inside, by `count`
/// alone, are states of one search, which is continued where a call needs more balls than those before; likewise the
/// gaps and the balls of SphereAim::kDistance. `most` bounds the numbers of all calls. For one thread at a time.
class KeptSearch {
 public:
  KeptSearch(const IndexedMesh& mesh, const SphereFitOptions& options, std::size_t most, Extractor extractor);
  ~KeptSearch();
  KeptSearch(const KeptSearch&) = delete;
  KeptSearch& operator=(const KeptSearch&) = delete;

  /// measure_coverage_curve().
  Result<CoverageCurve> curve(std::size_t count, const StageProgress& progress = {}, const std::stop_token& stop = {});
  /// The widest gaps of 1, 2, 3 ... balls of SphereAim::kDistance, among places of the boundary; fewer than `count`
  /// where no more balls are found.
  Result<std::vector<double>> gaps(std::size_t count, const std::stop_token& stop = {});
  /// fit_spheres() by `count`, for an aim that is not kAuto; that of the options is not read.
  Result<SphereFit> fit(std::size_t count, SphereAim aim, const StageProgress& progress = {},
                        const std::stop_token& stop = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Whether the curve for these options, which are valid, is that of the search.
bool has_kept_curve(const SphereFitOptions& options);
/// Whether the fit is a state of the search, too.
bool is_kept(const SphereFitOptions& options);

}  // namespace medial_vk
