// Balls inside a solid that come near to whatever is outside it: docs/theory.md, "Sets for distances".
#pragma once

#include <span>
#include <vector>

#include "medial_vk/ball.h"
#include "solid/probes.h"
#include "solid/solid.h"
#include "sphere_fits/quality/threads.h"

namespace medial_vk {

/// As many balls inside the solid as are given, from which the points outside of the probes have, on average, a smaller
/// distance. The first three quarters of them stay. Deterministic; throws Stopped, std::bad_alloc.
std::vector<Ball> nearer_balls(const Solid& solid, std::span<const Ball> balls, std::span<const Probe> probes,
                               const Threads& threads);

}  // namespace medial_vk
