// Tables for readers: columns as wide as their longest cell.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "check_reports/check_report.h"
#include "medial_vk/context.h"
#include "medial_vk/result.h"
#include "output/atomic_files/atomic_file.h"
#include "output/extraction_report/run_record.h"

namespace medial_vk::cli {

struct Column {
  std::string title;
  bool to_the_right = false;  ///< Right-aligned, for numbers.
};

/// One line per row, without trailing blanks.
std::string format_table(const std::vector<Column>& columns, const std::vector<std::vector<std::string>>& rows);

std::string device_table(const std::vector<DeviceDescription>& devices);
/// The conditions, then the first failure of each failed condition.
std::string check_table(const CheckReport& check);
/// The result of --check: ok, or kCheckFailed.
Status verdict(const CheckReport& check);
/// Prints the table of --check to standard output, or to standard error where that holds results; then the verdict.
Status print_check(const CheckReport& check, bool standard_output_has_results);
/// A line of a summary.
std::string labelled(const char* label, const std::string& text);
/// The sum; verbose: also the sum of each stage, since several meshes have the same stages.
std::string times_text(const std::vector<StageTime>& times, bool verbose);
/// A line for each file; without `names_stream` none for standard output.
std::string written_text(std::span<const OutputFile> files, bool names_stream = true);
std::string level_table(const ExtractionCounters& counters);

}  // namespace medial_vk::cli
