#include "ball_files/read_balls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "base/quoted.h"
#include "body_files/body_file.h"
#include "common/file_extension.h"
#include "input/csv_lines.h"
#include "input/text_scanner.h"
#include "output/medial_ply/medial_file.h"

namespace medial_vk {
namespace {

constexpr std::array<std::string_view, 5> kColumns = {"x", "y", "z", "radius", "level"};
constexpr std::size_t kLevel = 4;  // the only column that may be missing

struct BallOfLevel {
  Ball ball;
  double level = 0;
};

class BallTable {
 public:
  explicit BallTable(std::string name) : name_(std::move(name)) {}

  Status read_columns(std::string_view line, std::uint64_t number) {
    const std::vector<std::string_view> words = csv_words(line);
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      const auto count = std::ranges::count(words, kColumns[i]);
      if (count > 1) return line_error(name_, number, fmt::format("two columns are named {}", kColumns[i]));
      if (count == 1) column_[i] = static_cast<std::size_t>(std::ranges::find(words, kColumns[i]) - words.begin());
      if (count == 0 && i != kLevel) {
        return line_error(name_, number, "the first line must name the columns x, y, z and radius, in any order");
      }
    }
    if (std::ranges::find(words, "link") != words.end()) {
      return line_error(name_, number, "the balls are those of the links of a robot, which are several solids");
    }
    columns_ = words.size();
    return {};
  }

  Result<BallOfLevel> read_ball(std::string_view line, std::uint64_t number) const {
    const std::vector<std::string_view> words = csv_words(line);
    if (words.size() != columns_) {
      return line_error(name_, number, fmt::format("{} values, where the first line names {}", words.size(), columns_));
    }
    std::array<double, kColumns.size()> values = {};
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (!column_[i]) continue;
      std::string_view why;
      const std::string_view word = words[*column_[i]];
      if (!parse_coordinate(word, values[i], why)) {
        return line_error(name_, number, fmt::format("{}: {} {}", kColumns[i], quoted(word), why));
      }
    }
    const auto [x, y, z, radius, level] = values;
    if (!(radius > 0)) return line_error(name_, number, fmt::format("the radius {} is not positive", radius));
    return BallOfLevel{{{x, y, z}, radius}, level};
  }

 private:
  std::string name_;
  std::array<std::optional<std::size_t>, kColumns.size()> column_;
  std::size_t columns_ = 0;
};

Result<std::vector<Ball>> balls_of_medial_ply(const std::string& path) {
  const Result<std::string> bytes = read_table(path);
  if (!bytes) return bytes.error();
  const Result<MedialFile> file = decode_ply(bytes.value(), path);
  if (!file) return file.error();
  std::vector<Ball> balls;
  for (const MedialSphere& sphere : file.value().spheres) balls.push_back({sphere.centre, sphere.radius});
  return balls;
}

Result<std::vector<Ball>> balls_of_body(const std::string& path, BodyBalls which) {
  Result<BodyFile> file = read_body_file(path);
  if (!file) return file.error();
  return std::move(which == BodyBalls::kInside ? file.value().inside : file.value().cover);
}

Result<std::vector<Ball>> balls_of_table(const std::string& path) {
  const Result<std::string> text = read_table(path);
  if (!text) return text.error();
  return parse_balls(text.value(), path == "-" ? "stdin" : path);
}

}  // namespace

Result<std::vector<Ball>> parse_balls(std::string_view text, const std::string& name) {
  BallTable table(name);
  std::vector<Ball> balls;
  double last_level = -std::numeric_limits<double>::infinity();
  bool has_columns = false;
  for (CsvLines lines(text); lines.next();) {
    if (!has_columns) {
      if (Status status = table.read_columns(lines.line(), lines.number()); !status) return status.error();
      has_columns = true;
      continue;
    }
    const Result<BallOfLevel> read = table.read_ball(lines.line(), lines.number());
    if (!read) return read.error();
    if (read.value().level < last_level) continue;
    if (read.value().level > last_level) balls.clear();
    last_level = read.value().level;
    balls.push_back(read.value().ball);
  }
  if (balls.empty()) return file_error(name, "there is no ball");
  return balls;
}

Result<std::vector<Ball>> read_balls(const std::string& path, BodyBalls of_body) {
  const std::string extension = file_extension(path);
  Result<std::vector<Ball>> balls = extension == ".ply"   ? balls_of_medial_ply(path)
                                    : extension == ".npz" ? balls_of_body(path, of_body)
                                                          : balls_of_table(path);
  if (balls && balls.value().empty()) return file_error(path, "there is no ball");
  return balls;
}

}  // namespace medial_vk
