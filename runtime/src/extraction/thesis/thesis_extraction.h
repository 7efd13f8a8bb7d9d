// Medial spheres by the method of Sections 2.3 and 2.4, on the device: the mode for comparisons with the source.
#pragma once

#include "device/context_impl.h"
#include "device_commands/stop_word.h"
#include "device_mesh/device_mesh.h"
#include "medial_vk/medial_spheres.h"

namespace medial_vk {

/// As extract_medial_spheres() with Mode::kThesis, whose errors it has. The options have been checked.
Result<Extraction> extract_thesis(ContextImpl& context, DeviceMesh& mesh, const ExtractionOptions& options,
                                  StopWatch& watch);

}  // namespace medial_vk
