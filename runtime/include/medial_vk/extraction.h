// Extraction: medial spheres of a mesh, found on the device.
#pragma once

#include <functional>
#include <stop_token>

#include "medial_vk/indexed_mesh.h"
#include "medial_vk/medial_spheres.h"
#include "medial_vk/progress.h"
#include "medial_vk/result.h"

namespace medial_vk {

class Context;
class Scene;

/// Finds the medial spheres of `mesh` on the device of `context`. Blocks until it is done, or until `stop` is requested
/// from any thread, the callback included: the device then finishes its current dispatch, and the context is as before.
/// The spheres are exact to float; certify_spheres() (certify.h) gives the guarantee in double precision. Errors:
/// kUsage (an option out of range), kInvalidMesh (no extent), kOutOfMemory, kInterrupted, kInternal (device lost).
Result<Extraction> extract_medial_spheres(const IndexedMesh& mesh, const ExtractionOptions& options, Context& context,
                                          const ProgressCallback& progress = {}, const std::stop_token& stop = {});

/// The same for a mesh that is on the device already, for repeated extractions without another upload.
Result<Extraction> extract_medial_spheres(Scene& scene, const ExtractionOptions& options,
                                          const ProgressCallback& progress = {}, const std::stop_token& stop = {});

/// A function that finds the medial spheres of a mesh, exact to float, as extract_medial_spheres() does: on a device,
/// or by another method.
using Extractor = std::function<Result<Extraction>(const IndexedMesh& mesh, const ExtractionOptions& options,
                                                   const ProgressCallback& progress, const std::stop_token& stop)>;

/// An extractor on the device of `context`, which must outlive it. The mesh of the last extraction stays on the device,
/// so that another extraction of the same mesh requires no upload. For one thread at a time. Does not throw: if host
/// memory does not suffice for the extractor, its calls return kOutOfMemory.
Extractor device_extractor(Context& context);

}  // namespace medial_vk
