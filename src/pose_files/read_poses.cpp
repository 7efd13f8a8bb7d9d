#include "pose_files/read_poses.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "base/quoted.h"
#include "input/text_scanner.h"

namespace medial_vk {
namespace {

constexpr std::array<std::string_view, 7> kNames = {"x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr std::size_t kShift = 3;  // the first names are the shift
constexpr double kLargest = 1e18;  // distances are computed up to here

std::string_view trimmed(std::string_view word) {
  const std::size_t first = word.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return word.substr(first, word.find_last_not_of(" \t\r") - first + 1);
}

/// The words between commas; the separator of lines is not among them.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = line.find(',', begin);
    words.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == std::string_view::npos) return words;
    begin = comma + 1;
  }
}

class PoseTable {
 public:
  explicit PoseTable(std::string name) : name_(std::move(name)) {}

  Status read_names(std::string_view line, std::uint64_t number) {
    const std::vector<std::string_view> words = words_of(line);
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
    const std::vector<std::string_view> words = words_of(line);
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
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  PoseTable table(name);
  std::vector<Pose> poses;
  bool has_names = false;
  for (std::uint64_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.empty()) continue;
    if (!has_names) {
      if (Status status = table.read_names(line, number); !status) return status.error();
      has_names = true;
      continue;
    }
    const Result<Pose> pose = table.read_pose(line, number);
    if (!pose) return pose.error();
    poses.push_back(pose.value());
  }
  if (poses.empty()) return file_error(name, "there is no pose");
  return poses;
}

Result<std::vector<Pose>> read_poses(const std::string& path) {
  const bool is_stream = path == "-";
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(is_stream ? nullptr : std::fopen(path.c_str(), "rb"),
                                                               [](std::FILE* file) { return std::fclose(file); });
  std::FILE* file = is_stream ? stdin : opened.get();
  std::string bytes;
  if (file) {
    std::array<char, 1 << 16> part;
    for (std::size_t count; (count = std::fread(part.data(), 1, part.size(), file)) > 0;) {
      bytes.append(part.data(), count);
    }
  }
  if (!file || std::ferror(file)) {
    return file_error(is_stream ? "stdin" : path,
                      fmt::format("cannot be read: {}", std::strerror(errno == 0 ? EIO : errno)));
  }
  return parse_poses(bytes, is_stream ? "stdin" : path);
}

}  // namespace medial_vk
