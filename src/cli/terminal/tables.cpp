#include "cli/terminal/tables.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/terminal/messages.h"
#include "cli/terminal/numbers.h"
#include "common/tool_errors.h"

namespace medial_vk::cli {
namespace {

using Row = std::vector<std::string>;

/// The number of bytes that start a character of UTF-8: names of devices may hold more than ASCII.
std::size_t printed_width(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}

std::string format_row(const std::vector<Column>& columns, const std::vector<std::size_t>& widths, const Row& row) {
  std::string line;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string blanks(widths[i] - printed_width(row[i]), ' ');
    line += (i == 0 ? "" : "  ") + (columns[i].to_the_right ? blanks + row[i] : row[i] + blanks);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

}  // namespace

std::string format_table(const std::vector<Column>& columns, const std::vector<Row>& rows) {
  Row titles;
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    titles.push_back(columns[i].title);
    widths.push_back(printed_width(columns[i].title));
    for (const Row& row : rows) widths[i] = std::max(widths[i], printed_width(row[i]));
  }
  std::string table = format_row(columns, widths, titles);
  for (const Row& row : rows) table += format_row(columns, widths, row);
  return table;
}

std::string device_table(const std::vector<DeviceDescription>& devices) {
  std::vector<Row> rows;
  rows.reserve(devices.size());
  for (const DeviceDescription& device : devices) {
    rows.push_back({std::to_string(device.index), device.name, device.type, memory_size(device.memory_bytes),
                    device.driver, device.usable ? "yes" : fmt::format("no: {}", fmt::join(device.why_not, "; "))});
  }
  return format_table({{"index", true}, {"name"}, {"type"}, {"memory", true}, {"driver"}, {"usable"}}, rows);
}

std::string check_table(const CheckReport& check) {
  std::vector<Row> rows;
  std::string failures;
  for (const CheckLine& line : check.lines) {
    rows.push_back({line.condition, grouped(line.tested), grouped(line.failed),
                    fmt::format("{:.3g}{}{}", line.worst, line.unit.empty() ? "" : " ", line.unit)});
    if (line.failed > 0 && !line.first_failure.empty()) failures += "first failure: " + line.first_failure + "\n";
  }
  return format_table({{"condition"}, {"tested", true}, {"failed", true}, {"worst"}}, rows) + failures;
}

Status verdict(const CheckReport& check) {
  if (check.passed()) return {};
  return Error{kCheckFailed, "--check failed: the table names what does not hold"};
}

Status print_check(const CheckReport& check, bool standard_output_has_results) {
  const std::string table = check_table(check);
  if (standard_output_has_results) {
    print_message(table);
  } else if (Status status = print_result(table); !status) {
    return status;
  }
  return verdict(check);
}

std::string labelled(const char* label, const std::string& text) { return fmt::format("  {:<9} {}\n", label, text); }

std::string written_text(std::span<const OutputFile> files, bool names_stream) {
  std::string text;
  for (const OutputFile& file : files) {
    if (file.path == "-" && !names_stream) continue;
    const std::string name = file.path == "-" ? "standard output" : file.path;
    text += labelled("written", fmt::format("{} ({})", name, byte_size(file.bytes.size())));
  }
  return text;
}

std::string times_text(const std::vector<StageTime>& times, bool verbose) {
  double all = 0;
  std::vector<StageTime> sums;
  for (const StageTime& time : times) {
    all += time.seconds;
    const auto sum = std::ranges::find(sums, time.stage, &StageTime::stage);
    if (sum == sums.end()) {
      sums.push_back(time);
    } else {
      sum->seconds += time.seconds;
    }
  }
  if (!verbose) return duration(all);
  std::string steps;
  for (const StageTime& sum : sums) {
    steps += fmt::format("{}{} {}", steps.empty() ? "" : ", ", sum.stage, duration(sum.seconds));
  }
  return fmt::format("{} ({})", duration(all), steps);
}

std::string level_table(const ExtractionCounters& counters) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < counters.levels.size(); ++i) {
    const ExtractionCounters::Level& level = counters.levels[i];
    rows.push_back({std::to_string(i), fmt::format("{:.4g}", level.cell_size), grouped(level.visited),
                    grouped(level.kept), grouped(level.contacts), grouped(level.found)});
  }
  return format_table(
      {{"level", true}, {"cell size", true}, {"visited", true}, {"kept", true}, {"contacts", true}, {"found", true}},
      rows);
}

}  // namespace medial_vk::cli
