#include "pose_files/read_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/quoted.h"
#include "input/csv_lines.h"
#include "input/text_scanner.h"

namespace medial_vk {
namespace {

constexpr std::array<std::string_view, 7> kNames = {"x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr std::size_t kShift = 3;  // the first names are the shift
constexpr double kLargest = 1e18;  // distances are computed up to here

class PoseTable {
 public:
  explicit PoseTable(std::string name) : name_(std::move(name)) {}

  Status read_names(std::string_view line, std::uint64_t number) {
    const std::vector<std::string_view> words = csv_words(line);
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      const auto count = std::ranges::count(words, kNames[i]);
      if (count > 1) return line_error(name_, number, fmt::format("two columns are named {}", kNames[i]));
      if (count == 1) column_[i] = static_cast<std::size_t>(std::ranges::find(words, kNames[i]) - words.begin());
    }
    columns_ = words.size();
    const auto given = [](const std::optional<std::size_t>& column) { return column.has_value(); };
    const auto turned = std::count_if(column_.begin() + kShift, column_.end(), given);
    if (std::all_of(column_.begin(), column_.begin() + kShift, given) && (turned == 0 || turned == 4)) return {};
    return line_error(
        name_, number,
        "the first line must name the columns: x,y,z, and with a rotation also qx,qy,qz,qw, in any order");
  }

  Result<Pose> read_pose(std::string_view line, std::uint64_t number) const {
    const std::vector<std::string_view> words = csv_words(line);
    if (words.size() != columns_) {
      return line_error(name_, number, fmt::format("{} values, where the first line names {}", words.size(), columns_));
    }
    std::array<double, kNames.size()> values = {0, 0, 0, 0, 0, 0, 1};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      if (!column_[i]) continue;
      std::string_view why;
      const std::string_view word = words[*column_[i]];
      if (!parse_coordinate(word, values[i], why)) {
        return line_error(name_, number, fmt::format("{}: {} {}", kNames[i], quoted(word), why));
      }
      if (std::fabs(values[i]) > kLargest) {
        return line_error(name_, number, fmt::format("{}: {} is beyond {:g}", kNames[i], quoted(word), kLargest));
      }
    }
    const auto [x, y, z, qx, qy, qz, qw] = values;
    const double norm = std::hypot(std::hypot(qx, qy), std::hypot(qz, qw));
    if (!(std::fabs(norm - 1) <= 0.01)) {
      return line_error(name_, number, fmt::format("the quaternion has the length {:.4g} instead of 1", norm));
    }
    return make_pose({x, y, z}, Quaternion(qx, qy, qz, qw));
  }

 private:
  std::string name_;
  std::array<std::optional<std::size_t>, kNames.size()> column_;
  std::size_t columns_ = 0;
};

}  // namespace

Result<std::vector<Pose>> parse_poses(std::string_view text, const std::string& name) {
  PoseTable table(name);
  std::vector<Pose> poses;
  bool has_names = false;
  for (CsvLines lines(text); lines.next();) {
    if (!has_names) {
      if (Status status = table.read_names(lines.line(), lines.number()); !status) return status.error();
      has_names = true;
      continue;
    }
    const Result<Pose> pose = table.read_pose(lines.line(), lines.number());
    if (!pose) return pose.error();
    poses.push_back(pose.value());
  }
  if (poses.empty()) return file_error(name, "there is no pose");
  return poses;
}

Result<std::vector<Pose>> read_poses(const std::string& path) {
  const Result<std::string> text = read_table(path);
  if (!text) return text.error();
  return parse_poses(text.value(), path == "-" ? "stdin" : path);
}

}  // namespace medial_vk
