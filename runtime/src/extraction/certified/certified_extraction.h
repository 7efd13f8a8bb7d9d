// Medial spheres by the certified mode, on the device.
#pragma once

#include "device/context_impl.h"
#include "device_commands/stop_word.h"
#include "device_mesh/device_mesh.h"
#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// As extract_medial_spheres() with Mode::kCertified, whose errors it has. The options have been checked.
Result<Extraction> extract_certified(ContextImpl& context, DeviceMesh& mesh, const ExtractionOptions& options,
                                     StopWatch& watch);

}  // namespace medial_vk
