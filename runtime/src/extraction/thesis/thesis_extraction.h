// Medial spheres as Sections 2.3 and 2.4 describe them, on the device: the mode that results can be compared in.
#pragma once

#include "commands/stop_word.h"
#include "device/context_impl.h"
#include "device_mesh/device_mesh.h"
#include "medial_vk/extraction.h"

namespace medial_vk {

/// As extract_medial_spheres() with Mode::kThesis, whose errors it has. The parameters have been checked.
Result<Extraction> extract_thesis(Context::Impl& context, DeviceMesh& mesh, const ExtractionOptions& options,
                                  StopWatch& watch);

}  // namespace medial_vk
