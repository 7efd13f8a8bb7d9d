// The summary and the report of `medial-vk voronoi`, of sites in space.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "medial_vk/measurements.h"
#include "output/atomic_files/atomic_file.h"
#include "output/site_files/site_record.h"

namespace medial_vk::cli {

std::string voronoi_summary(const SiteRecord& record, const std::vector<StageTime>& times,
                            std::span<const OutputFile> files, bool verbose);

/// The bytes of --report (docs/formats.md, "Surfaces between sites").
std::string voronoi_report(const SiteRecord& record, const std::vector<StageTime>& times);

}  // namespace medial_vk::cli
