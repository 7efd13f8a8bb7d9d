// How work of several stages tells how far it is.
#pragma once

#include <functional>

namespace medial_vk {

/// Called with the stage ("extract", "certify") and the share of it done; return false to stop.
using StageProgress = std::function<bool(const char* stage, double done)>;

}  // namespace medial_vk
