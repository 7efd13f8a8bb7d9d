// Where the volume between a surface and the balls inside it has grown since the rest pose (docs/theory.md, "Balls
// chosen anew").
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "following/gap_samples.h"
#include "following/surface/moving_surface.h"
#include "medial_vk/ball.h"
#include "threads/worker_pool.h"

namespace medial_vk {

/// Regions of the surface whose uncovered share of the solid's volume, as estimated, is more than a factor times that
/// in the rest pose. They count if together they have grown by more than a twentieth of all that is uncovered in the
/// rest pose: where next to nothing is uncovered, a multiple of it is still nothing.
class RegionalGrowth {
 public:
  /// `surface`, `balls` and `volume`, that of the solid: of the rest pose. Throws std::bad_alloc.
  RegionalGrowth(const MovingSurface& surface, std::span<const Ball> balls, double volume, double factor);

  const GapSamples& samples() const { return samples_; }

  /// True if there are such regions. A volume that is not a number: false.
  bool has_grown(const MovingSurface& surface, std::span<const Ball> balls, double volume, WorkerPool& pool);
  /// Chooses those of them that have grown since the last tried(), too, if that growth also counts; true if it does.
  bool choose(const MovingSurface& surface, std::span<const Ball> balls, double volume, WorkerPool& pool);
  /// By region: 1 if it was chosen.
  std::span<const std::uint8_t> chosen() const { return chosen_; }
  void choose_all();
  /// Balls have been exchanged in the chosen regions, and no further one was worth it: they wait until they have grown
  /// again.
  void tried(const MovingSurface& surface, std::span<const Ball> balls, double volume);
  void return_to_rest();

 private:
  bool choose_beyond(const MovingSurface& surface, std::span<const Ball> balls, double volume,
                     std::span<const double> known, WorkerPool& pool);
  double growth(std::uint32_t region, double known, double volume) const;

  GapSamples samples_;
  double factor_;
  double least_ = 0;                  // growth that counts
  std::vector<double> rest_, tried_;  // by region, as shares of the volume
  std::vector<std::uint8_t> chosen_;
};

}  // namespace medial_vk
