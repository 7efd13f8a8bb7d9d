#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/quoted.h"
#include "input/csv_lines.h"
#include "input/text_scanner.h"
#include "shape_files/shape_readers.h"

namespace medial_vk {
namespace {

std::string lower_cased(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

class RingTable {
 public:
  explicit RingTable(const std::string& name) : name_(name) {}

  Status read_line(std::string_view line, std::uint64_t number) {
    const std::vector<std::string_view> words = csv_words(line);
    if (columns_ == 0) {
      bool names = false;
      if (Status status = read_names(words, number, names); !status || names) return status;
    }
    if (words.size() != columns_) {
      return line_error(name_, number, fmt::format("{} values, where the first line has {}", words.size(), columns_));
    }
    PlanePoint p = {};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string_view word = words[column_[k]];
      std::string_view why;
      if (!parse_coordinate(word, p[k], why)) return line_error(name_, number, fmt::format("{} {}", quoted(word), why));
      if (std::fabs(p[k]) > kMostPlaneCoordinate) {
        return line_error(name_, number, fmt::format("{} is beyond 1e150", quoted(word)));
      }
    }
    const std::string_view ring = ring_ ? words[*ring_] : std::string_view();
    const bool begins = rings_.empty() || number > line_ + 1 || ring != last_ring_;
    if (begins) rings_.emplace_back();
    rings_.back().push_back(p);
    last_ring_ = ring;
    line_ = number;
    return {};
  }

  std::vector<PlaneRing> take_rings() {
    for (PlaneRing& ring : rings_) {
      if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
    }
    return std::move(rings_);
  }

 private:
  /// The first line: `names` if it names columns; otherwise they are x, y and, if there are three, ring.
  Status read_names(const std::vector<std::string_view>& words, std::uint64_t number, bool& names) {
    const auto is_number = [](std::string_view word) {
      double value = 0;
      std::string_view why;
      return parse_coordinate(word, value, why);
    };
    columns_ = words.size();
    names = std::ranges::none_of(words, is_number);
    if (!names) {
      if (columns_ != 2 && columns_ != 3) {
        return line_error(name_, number, fmt::format("{} values instead of x,y or x,y,ring", columns_));
      }
      if (columns_ == 3) ring_ = 2;
      return {};
    }
    constexpr std::array<std::string_view, 3> kColumns = {"x", "y", "ring"};
    std::vector<std::string> lower(words.size());
    std::ranges::transform(words, lower.begin(), lower_cased);
    for (std::size_t k = 0; k < kColumns.size(); ++k) {
      const auto count = std::ranges::count(lower, kColumns[k]);
      if (count > 1) return line_error(name_, number, fmt::format("two columns are named {}", kColumns[k]));
      const auto at = static_cast<std::size_t>(std::ranges::find(lower, kColumns[k]) - lower.begin());
      if (k < 2 && count == 0) {
        return line_error(name_, number,
                          "the first line must name the columns x and y, and others as it likes, or none");
      }
      if (k < 2) column_[k] = at;
      if (k == 2 && count == 1) ring_ = at;
    }
    line_ = number;
    return {};
  }

  const std::string& name_;
  std::size_t columns_ = 0;
  std::array<std::size_t, 2> column_ = {0, 1};
  std::optional<std::size_t> ring_;
  std::vector<PlaneRing> rings_;
  std::string_view last_ring_;
  std::uint64_t line_ = 0;
};

}  // namespace

Result<AreasOfFile> read_ring_table(std::string_view bytes, const std::string& name) {
  RingTable table(name);
  for (CsvLines lines(bytes); lines.next();) {
    if (Status status = table.read_line(lines.line(), lines.number()); !status) return status.error();
  }
  AreasOfFile read;
  read.areas.push_back({table.take_rings(), FillRule::kEvenOdd});
  if (read.areas.front().rings.empty()) return file_error(name, "there is no point");
  return read;
}

}  // namespace medial_vk
