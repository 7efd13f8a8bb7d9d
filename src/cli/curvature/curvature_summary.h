// The summary and the report of `medial-vk curvature`.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "boundary_fields/boundary_fields.h"
#include "medial_vk/measurements.h"
#include "output/atomic_files/atomic_file.h"
#include "output/curvature_files/curvature_files.h"

namespace medial_vk::cli {

/// Of numbers that are known; NaN if none is.
struct ValueRange {
  double least, median, greatest;
};

struct CurvatureSummary {
  std::string balls_file;
  std::string method;
  std::uint64_t balls = 0;
  double spacing = 0;
  std::array<std::uint64_t, kTipStates> tips = {};  ///< By state.
  std::array<ValueRange, 2> kappa = {};
  ValueRange error = {};
};

CurvatureSummary summarize(const std::string& balls_file, const CurvatureTable& table);

std::string curvature_summary(const CurvatureSummary& summary, const std::vector<StageTime>& times,
                              std::span<const OutputFile> files, bool verbose);

/// The bytes of --report (docs/formats.md, Curvatures).
std::string curvature_report(const CurvatureSummary& summary, const std::vector<StageTime>& times);

}  // namespace medial_vk::cli
