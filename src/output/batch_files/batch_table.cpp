#include "output/batch_files/batch_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

namespace medial_vk {
namespace {

constexpr std::array<std::string_view, kBatchColumns> kColumnNames = {
    "name",         "state",      "error",        "triangles",       "closed",         "longest_side",
    "volume",       "points",     "sheets",       "undecided",       "least_radius",   "greatest_radius",
    "balls_volume", "balls_area", "seconds_read", "seconds_prepare", "seconds_search", "seconds",
    "device",       "content",    "options",      "version"};

std::string cell(std::string_view text) {
  std::string plain;
  for (const char c : text) plain += c == '\n' || c == '\r' ? ' ' : c;
  if (plain.find_first_of(",\"") == std::string::npos) return plain;
  std::string out = "\"";
  for (const char c : plain) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// The texts between commas, of which quotes hold any; none if a quote is not where it may be.
std::optional<std::vector<std::string>> split_cells(std::string_view line) {
  std::vector<std::string> cells(1);
  std::size_t i = 0;
  const auto read_quoted = [&] {
    for (++i; i < line.size(); ++i) {
      if (line[i] != '"') {
        cells.back() += line[i];
      } else if (i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += line[i++];
      } else {
        ++i;
        return i == line.size() || line[i] == ',';
      }
    }
    return false;
  };
  while (i < line.size()) {
    if (line[i] == '"') {
      if (!cells.back().empty() || !read_quoted()) return std::nullopt;
    } else if (line[i] == ',') {
      cells.emplace_back();
      ++i;
    } else {
      cells.back() += line[i++];
    }
  }
  return cells;
}

std::optional<BatchRow> decode_row(std::string_view line) {
  std::optional<std::vector<std::string>> cells = split_cells(line);
  if (!cells || cells->size() != kBatchColumns) return std::nullopt;
  BatchRow row;
  std::ranges::move(*cells, row.texts.begin());
  const std::string& state = row[BatchColumn::kState];
  if (row[BatchColumn::kName].empty() || (state != kBatchDone && state != kBatchFailed)) return std::nullopt;
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
    line += cell(row.texts[i]);
  }
  return line + "\n";
}

Result<std::vector<BatchRow>> decode_batch_table(std::string_view bytes) {
  const std::string header = batch_table_header();
  if (!bytes.starts_with(header)) {
    return Error{ErrorCode::kInvalidMesh, "line 1: these are not the columns of a table of medial-vk batch"};
  }
  std::vector<BatchRow> rows;
  std::unordered_map<std::string, std::size_t> row_of;
  bytes.remove_prefix(header.size());
  for (std::size_t number = 2; !bytes.empty(); ++number) {
    const std::size_t end = bytes.find('\n');
    if (end == std::string_view::npos) break;  // cut off
    std::optional<BatchRow> row = decode_row(bytes.substr(0, end));
    if (!row) {
      return Error{ErrorCode::kInvalidMesh,
                   fmt::format("line {}: it is no line of a table of medial-vk batch", number)};
    }
    const auto [at, is_new] = row_of.try_emplace((*row)[BatchColumn::kName], rows.size());
    if (is_new) {
      rows.push_back(std::move(*row));
    } else {
      rows[at->second] = std::move(*row);
    }
    bytes.remove_prefix(end + 1);
  }
  return rows;
}

}  // namespace medial_vk
