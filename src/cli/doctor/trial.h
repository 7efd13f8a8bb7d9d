// The small extraction that shows whether a device works: a turned torus of 1,024 triangles, about 500 medial spheres.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "medial_vk/extraction.h"
#include "medial_vk/indexed_mesh.h"
#include "medial_vk/result.h"
#include "output/doctor_report/doctor_record.h"

namespace medial_vk::cli {

/// The solid, the options and the answer of the CPU reference.
struct TrialTask {
  IndexedMesh mesh;
  ExtractionOptions options;
  Extraction reference;
  double reference_seconds = 0;
};

/// On this thread alone. Error: kOutOfMemory.
Result<TrialTask> make_trial_task();

/// Runs the extraction on the device of this index, in a process of its own, and compares. If it fails while programs
/// are cached in `cache_folder`, it runs a second time without them.
TrialRecord try_device(const TrialTask& task, std::uint32_t device, const std::string& cache_folder,
                       std::chrono::milliseconds limit);

}  // namespace medial_vk::cli
