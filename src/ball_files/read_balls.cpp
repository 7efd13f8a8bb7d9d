#include "ball_files/read_balls.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "ball_files/ball_arrays.h"
#include "ball_files/ball_faults.h"
#include "base/quoted.h"
#include "body_files/body_file.h"
#include "common/file_extension.h"
#include "input/csv_lines.h"
#include "input/text_scanner.h"
#include "output/medial_ply/medial_file.h"

namespace medial_vk {
namespace {

constexpr std::array<std::string_view, 11> kColumns = {
    "x", "y", "z", "radius", "level", "spoke_a_x", "spoke_a_y", "spoke_a_z", "spoke_b_x", "spoke_b_y", "spoke_b_z"};
constexpr std::size_t kLevel = 4, kSpokes = 5;  // columns from the first one on may be missing

struct BallOfLevel {
  Ball ball;
  double level = 0;
  SpokePair spokes;
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
      if (count == 0 && i < kLevel) {
        return line_error(name_, number,
                          "the first line must name the columns x, y, z and radius, in any order (a file of balls is "
                          "such a table, a medial PLY, or an .npz or .json that this program wrote)");
      }
    }
    if (std::ranges::find(words, "link") != words.end()) {
      return line_error(name_, number, "the balls are those of the links of a robot, which are several solids");
    }
    columns_ = words.size();
    const auto is_named = [](const std::optional<std::size_t>& column) { return column.has_value(); };
    const auto side = std::ranges::find(words, "side");
    if (side != words.end()) side_ = static_cast<std::size_t>(side - words.begin());
    has_spokes_ = std::all_of(column_.begin() + kSpokes, column_.end(), is_named);
    return {};
  }

  bool has_spokes() const { return has_spokes_; }

  Result<BallOfLevel> read_ball(std::string_view line, std::uint64_t number) const {
    const std::vector<std::string_view> words = csv_words(line);
    if (words.size() != columns_) {
      return line_error(name_, number, fmt::format("{} values, where the first line names {}", words.size(), columns_));
    }
    if (side_ && words[*side_] == "outside") return outside_error(fmt::format("{}:{}", name_, number));
    std::array<double, kColumns.size()> values = {};
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (!column_[i] || (i >= kSpokes && !has_spokes_)) continue;
      std::string_view why;
      const std::string_view word = words[*column_[i]];
      if (!parse_coordinate(word, values[i], why)) {
        return line_error(name_, number, fmt::format("{}: {} {}", kColumns[i], quoted(word), why));
      }
    }
    const Ball ball = {{values[0], values[1], values[2]}, values[3]};
    const SpokePair spokes = {as_written({values[5], values[6], values[7]}),
                              as_written({values[8], values[9], values[10]})};
    const std::string fault = fault_of_ball(ball, has_spokes_ ? &spokes : nullptr);
    if (!fault.empty()) return line_error(name_, number, fault);
    return BallOfLevel{ball, values[kLevel], spokes};
  }

 private:
  std::string name_;
  std::array<std::optional<std::size_t>, kColumns.size()> column_;
  std::optional<std::size_t> side_;
  std::size_t columns_ = 0;
  bool has_spokes_ = false;
};

Result<BallsWithSpokes> balls_of_medial_ply(const std::string& path) {
  const Result<std::string> bytes = read_table(path);
  if (!bytes) return bytes.error();
  const Result<MedialFile> file = decode_ply(bytes.value(), path);
  if (!file) return file.error();
  if (file.value().header.inside_count.value_or(file.value().spheres.size()) < file.value().spheres.size()) {
    return outside_error(path);
  }
  const auto point = [](const std::array<float, 3>& spoke) { return Point{spoke[0], spoke[1], spoke[2]}; };
  BallsWithSpokes out;
  out.balls.reserve(file.value().spheres.size());
  out.spokes.reserve(file.value().spheres.size());
  for (const MedialSphere& sphere : file.value().spheres) {
    out.balls.push_back({sphere.centre, sphere.radius});
    out.spokes.push_back({point(sphere.spoke_a), point(sphere.spoke_b)});
  }
  if (Status status = check_all(out, path); !status) return status.error();
  return out;
}

Result<BallsWithSpokes> balls_of_npz(const std::string& path, BodyBalls which) {
  const Result<std::string> bytes = read_table(path);
  if (!bytes) return bytes.error();
  // The names of an archive's members are in it as they are.
  if (bytes.value().find("inside_centre.npy") == std::string::npos) return balls_of_arrays(bytes.value(), path);
  Result<BodyFile> file = decode_body_file(bytes.value(), path);
  if (!file) return file.error();
  return BallsWithSpokes{std::move(which == BodyBalls::kInside ? file.value().inside : file.value().cover), {}};
}

Result<BallsWithSpokes> balls_of_json_file(const std::string& path) {
  const Result<std::string> text = read_table(path);
  if (!text) return text.error();
  return balls_of_json(text.value(), path);
}

Result<BallsWithSpokes> balls_of_table(const std::string& path) {
  const Result<std::string> text = read_table(path);
  if (!text) return text.error();
  return parse_balls_with_spokes(text.value(), path == "-" ? "stdin" : path);
}

Result<std::vector<Ball>> without_spokes(Result<BallsWithSpokes> read) {
  if (!read) return read.error();
  return std::move(read.value().balls);
}

}  // namespace

Result<BallsWithSpokes> parse_balls_with_spokes(std::string_view text, const std::string& name) {
  BallTable table(name);
  BallsWithSpokes out;
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
    if (read.value().level > last_level) out = {};
    last_level = read.value().level;
    out.balls.push_back(read.value().ball);
    if (table.has_spokes()) out.spokes.push_back(read.value().spokes);
  }
  if (out.balls.empty()) return file_error(name, "there is no ball");
  return out;
}

Result<std::vector<Ball>> parse_balls(std::string_view text, const std::string& name) {
  return without_spokes(parse_balls_with_spokes(text, name));
}

Result<BallsWithSpokes> read_balls_with_spokes(const std::string& path, BodyBalls of_body) {
  const std::string extension = file_extension(path);
  if (extension == ".glb") {
    return file_error(path,
                      "glTF has balls as nodes or triangles, rounded to floats; give the .ply, .npz, .json or .csv");
  }
  Result<BallsWithSpokes> read = extension == ".ply"    ? balls_of_medial_ply(path)
                                 : extension == ".npz"  ? balls_of_npz(path, of_body)
                                 : extension == ".json" ? balls_of_json_file(path)
                                                        : balls_of_table(path);
  if (read && read.value().balls.empty()) return file_error(path, "there is no ball");
  return read;
}

Result<std::vector<Ball>> read_balls(const std::string& path, BodyBalls of_body) {
  return without_spokes(read_balls_with_spokes(path, of_body));
}

}  // namespace medial_vk
