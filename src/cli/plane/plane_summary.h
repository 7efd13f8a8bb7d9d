// The summary and the report of `medial-vk plane`.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "medial_vk/measurements.h"
#include "output/atomic_files/atomic_file.h"
#include "output/plane_files/plane_record.h"

namespace medial_vk::cli {

std::string plane_summary(const PlaneRecord& record, const std::vector<StageTime>& times,
                          std::span<const OutputFile> files, bool verbose);

/// The bytes of --report (docs/formats.md, Axes in the plane).
std::string plane_report(const PlaneRecord& record, const std::vector<StageTime>& times);

}  // namespace medial_vk::cli
