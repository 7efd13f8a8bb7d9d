// The summary and the report of `medial-vk fit`.
#pragma once

#include <span>
#include <string>

#include "output/atomic_files/atomic_file.h"
#include "output/hull_files/hull_record.h"

namespace medial_vk::cli {

/// Before the fit: the mesh, what was assumed of it, and what computes.
std::string fit_opening(const HullRecord& record);

std::string fit_summary(const HullRecord& record, std::span<const OutputFile> files, bool verbose);

/// The bytes of --report: JSON; every key is described in docs/report.md.
std::string fit_report(const HullRecord& record);

}  // namespace medial_vk::cli
