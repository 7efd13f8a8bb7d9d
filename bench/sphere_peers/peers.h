// The methods by name, and the measures of their balls.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "gradient_fit.h"
#include "k_means.h"
#include "medial_vk/ball.h"
#include "set_cover.h"
#include "solid/solid.h"

namespace medial_vk::bench {

struct PeerOptions {
  std::size_t count = 64;  ///< At most so many balls.
  std::uint64_t seed = 1;
  unsigned threads = 0;        ///< 0: one per core. Balls do not depend on it.
  KMeansOptions k_means;       ///< Its count, seed and threads are not read.
  SetCoverOptions set_cover;   ///< Its count and threads are not read.
  GradientFitOptions descent;  ///< Its count, weights, seed and threads are not read.
};

/// What the balls of a method have by construction.
enum class PeerPromise : std::uint8_t { kNone, kInside, kCover };

struct PeerMethod {
  const char* name;
  PeerPromise promise;
  std::vector<Ball> (*fit)(const Solid& solid, const PeerOptions& options);  ///< Of a solid with a volume.
};

std::span<const PeerMethod> peer_methods();

/// What the table says of a set of balls, all of it by measure_spheres().
struct PeerMeasures {
  std::size_t spheres = 0;
  bool is_inside = false, is_cover = false;  ///< Proved.
  // Shares of the volume of the solid, in percent; exact if one of the two is proved.
  double uncovered = 0, added = 0, standard_error = 0;
  // Upper bounds, in percent of the diagonal.
  double protrusion = 0;  ///< The greatest distance of a point of the balls from the solid.
  double hausdorff = 0;   ///< Of the surfaces, two-sided.
};

/// Precondition: at least one ball. Ends the program if measuring fails.
PeerMeasures measure_peer(const Solid& solid, std::span<const Ball> balls, unsigned threads);

}  // namespace medial_vk::bench
