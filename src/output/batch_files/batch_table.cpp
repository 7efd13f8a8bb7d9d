#include "output/batch_files/batch_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

#include "common/csv_cell.h"

namespace medial_vk {
namespace {

constexpr std::array<std::string_view, kBatchColumns> kColumnNames = {
    "name",
    "state",
    "error",
    "file",
    "triangles",
    "closed",
    "longest_side",
    "volume",
    "points",
    "sheets",
    "undecided",
    "least_radius",
    "greatest_radius",
    "balls_volume",
    "balls_area",
    "least_wall_lower",
    "least_wall_upper",
    "least_gap_lower",
    "least_gap_upper",
    "thickness_lower",
    "thickness_upper",
    "seconds_read",
    "seconds_prepare",
    "seconds_search",
    "seconds",
    "device",
    "files",
    "content",
    "options",
    "version",
};

std::string in_one_line(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

/// The texts between commas, of which quotes hold any.
struct Cells {
  std::vector<std::string> texts = std::vector<std::string>(1);
  bool is_whole = true;  ///< False: a quote is where it may not be, within the last text.
};

Cells split_cells(std::string_view line) {
  Cells out;
  std::size_t i = 0;
  const auto read_quoted = [&] {
    for (++i; i < line.size(); ++i) {
      if (line[i] != '"') {
        out.texts.back() += line[i];
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        out.texts.back() += line[i++];
      } else {
        ++i;
        return i == line.size() || line[i] == ',';
      }
    }
    return false;
  };
  while (i < line.size()) {
    if (line[i] == '"') {
      out.is_whole = out.texts.back().empty() && read_quoted();
      if (!out.is_whole) return out;
    } else if (line[i] == ',') {
      out.texts.emplace_back();
      ++i;
    } else {
      out.texts.back() += line[i++];
    }
  }
  return out;
}

std::optional<BatchRow> row_of_cells(Cells cells) {
  if (!cells.is_whole || cells.texts.size() != kBatchColumns) return std::nullopt;
  BatchRow row;
  std::ranges::move(cells.texts, row.texts.begin());
  const bool is_known = row.has_results() || row.is_at_work() || row[BatchColumn::kState] == kBatchFailed;
  if (row[BatchColumn::kName].empty() || !is_known) return std::nullopt;
  return row;
}

}  // namespace

std::string batch_table_header() {
  std::string line;
  for (const std::string_view name : kColumnNames) {
    if (!line.empty()) line += ',';
    line += name;
  }
  return line + "\n";
}

std::string encode_batch_row(const BatchRow& row) {
  std::string line;
  for (std::size_t i = 0; i < kBatchColumns; ++i) {
    if (i > 0) line += ',';
    line += csv_cell(in_one_line(row.texts[i]));
  }
  return line + "\n";
}

Result<BatchTable> decode_batch_table(std::string_view bytes) {
  const std::string header = batch_table_header();
  if (!bytes.starts_with(header)) {
    return Error{ErrorCode::kInvalidMesh, "line 1: these are not the columns of a table of medial-vk batch"};
  }
  BatchTable table;
  std::vector<BatchRow>& rows = table.rows;
  std::unordered_map<std::string, std::size_t> row_of;
  bytes.remove_prefix(header.size());
  for (std::uint64_t number = 2; !bytes.empty(); ++number) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) break;  // cut off
    Cells cells = split_cells(bytes.substr(0, end));
    bytes.remove_prefix(end + 1);
    const auto before = row_of.find(cells.texts.front());
    std::optional<BatchRow> row = row_of_cells(std::move(cells));
    if (!row) {
      table.damaged_lines.push_back(number);
      if (before != row_of.end()) rows[before->second][BatchColumn::kState] = kBatchStarted;
      continue;
    }
    if (before != row_of.end()) rows[before->second][BatchColumn::kName].clear();  // an earlier line of the mesh
    row_of.insert_or_assign((*row)[BatchColumn::kName], rows.size());
    rows.push_back(std::move(*row));
  }
  std::erase_if(rows, [](const BatchRow& row) { return row[BatchColumn::kName].empty(); });
  return table;
}

}  // namespace medial_vk
