// Where the volume between a surface and the balls inside it has grown since the rest pose (docs/theory.md, "Balls
// chosen anew").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "following/gap_samples.h"
#include "following/moving_surface.h"
#include "medial_vk/ball.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// Regions of the surface whose uncovered share of the solid's volume, as estimated, has grown by more than a factor. A
/// region whose share at rest is below the mean of all regions counts as one with the mean: where next to nothing is
/// uncovered, a multiple of it is still nothing.
class RegionalGrowth {
 public:
  /// `surface`, `balls` and `volume`, that of the solid: of the rest pose. Throws std::bad_alloc.
  RegionalGrowth(const MovingSurface& surface, std::span<const Ball> balls, double volume, double factor);

  const GapSamples& samples() const { return samples_; }

  /// True if a region has grown by more than the factor. A volume that is not a number: false.
  bool has_grown(const MovingSurface& surface, std::span<const Ball> balls, double volume, WorkerPool& pool);
  /// Chooses the regions that have grown by more than the factor, and since the last tried() by a quarter more; true if
  /// there is one.
  bool choose(const MovingSurface& surface, std::span<const Ball> balls, double volume, WorkerPool& pool);
  /// By region: 1 if it was chosen.
  std::span<const std::uint8_t> chosen() const { return chosen_; }
  void choose_all();
  /// Balls have been exchanged in the chosen regions, and no further one was worth it: they wait until they have grown
  /// again.
  void tried(const MovingSurface& surface, std::span<const Ball> balls, double volume);
  void return_to_rest();

 private:
  double share(std::uint32_t region, double volume) const { return samples_.volume(region) / volume; }

  GapSamples samples_;
  // By region, as shares of the volume: with more than the first one, balls are exchanged; what tried() found.
  std::vector<double> most_, tried_;
  std::vector<std::uint8_t> chosen_;
};

}  // namespace medial_vk
