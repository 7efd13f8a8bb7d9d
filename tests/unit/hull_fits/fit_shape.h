// A mesh into which hulls are fitted, and its medial points by the reference.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <stop_token>

#include "medial_vk/hull_fits.h"
#include "medial_vk/prepare.h"
#include "reference_bridge/reference_extractor.h"
#include "support/indexed.h"

namespace medial_vk {

inline constexpr std::array kEachKind = {HullChoice::kBalls, HullChoice::kCapsules, HullChoice::kCones,
                                         HullChoice::kSlabs};

/// A mesh and its medial points, which are extracted once.
struct FitShape {
  explicit FitShape(const Mesh& raw) : mesh(test::indexed(prepare_mesh(raw).value())) {}

  FitShape(const FitShape&) = delete;
  FitShape& operator=(const FitShape&) = delete;

  Extractor extractor() {
    return [this](const IndexedMesh& of, const ExtractionOptions& options, const ProgressCallback& progress,
                  const std::stop_token& stop) -> Result<Extraction> {
      if (found && resolution == options.resolution) {
        if (progress) progress(1);
        return *found;
      }
      Result<Extraction> made = reference_extractor()(of, options, progress, stop);
      if (made) found = made.value();
      resolution = options.resolution;
      return made;
    };
  }
  Result<HullFit> fit(HullFitOptions options, const StageProgress& progress = {}, const std::stop_token& stop = {}) {
    if (options.resolution == 0) options.resolution = 16;
    return fit_hulls(mesh, options, extractor(), progress, stop);
  }

  IndexedMesh mesh;
  std::optional<Extraction> found;
  std::uint32_t resolution = 0;
};

}  // namespace medial_vk
