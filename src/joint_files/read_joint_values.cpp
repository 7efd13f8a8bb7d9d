#include "joint_files/read_joint_values.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "base/quoted.h"
#include "input/csv_lines.h"
#include "input/text_scanner.h"

namespace medial_vk {
namespace {

constexpr double kMostPosition = 1e18;  // distances are computed up to here

class JointTable {
 public:
  JointTable(const std::string& name, std::span<const std::string> joints) : name_(name), joints_(joints) {}

  Status read_names(std::string_view line, std::uint64_t number) {
    const std::vector<std::string_view> words = csv_words(line);
    columns_ = words.size();
    std::map<std::string_view, std::size_t> column_of;
    std::map<std::string_view, std::size_t> times;
    for (std::size_t i = 0; i < words.size(); ++i) {
      column_of.emplace(words[i], i);
      ++times[words[i]];
    }
    for (const std::string& joint : joints_) {
      const auto column = column_of.find(joint);
      if (column == column_of.end()) {
        return line_error(name_, number,
                          fmt::format("there is no column for the joint {}; the first line names a "
                                      "column for each of {} joints",
                                      quoted(joint), joints_.size()));
      }
      if (times[joint] > 1) return line_error(name_, number, fmt::format("two columns are named {}", quoted(joint)));
      column_.push_back(column->second);
    }
    return {};
  }

  Result<std::vector<double>> read_values(std::string_view line, std::uint64_t number) const {
    const std::vector<std::string_view> words = csv_words(line);
    if (words.size() != columns_) {
      return line_error(name_, number, fmt::format("{} values, where the first line names {}", words.size(), columns_));
    }
    std::vector<double> values(joints_.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::string_view why;
      const std::string_view word = words[column_[i]];
      if (!parse_coordinate(word, values[i], why)) {
        return line_error(name_, number, fmt::format("{}: {} {}", quoted(joints_[i]), quoted(word), why));
      }
      if (std::fabs(values[i]) > kMostPosition) {
        return line_error(name_, number,
                          fmt::format("{}: {} is beyond {:g}", quoted(joints_[i]), quoted(word), kMostPosition));
      }
    }
    return values;
  }

 private:
  const std::string& name_;
  std::span<const std::string> joints_;
  std::vector<std::size_t> column_;  // of each joint
  std::size_t columns_ = 0;
};

}  // namespace

Result<std::vector<std::vector<double>>> parse_joint_values(std::string_view text, const std::string& name,
                                                            std::span<const std::string> joints) {
  JointTable table(name, joints);
  std::vector<std::vector<double>> configurations;
  bool has_names = false;
  for (CsvLines lines(text); lines.next();) {
    if (!has_names) {
      if (Status status = table.read_names(lines.line(), lines.number()); !status) return status.error();
      has_names = true;
      continue;
    }
    Result<std::vector<double>> values = table.read_values(lines.line(), lines.number());
    if (!values) return values.error();
    configurations.push_back(std::move(values).value());
  }
  if (configurations.empty()) return file_error(name, "there is no configuration");
  return configurations;
}

Result<std::vector<std::vector<double>>> read_joint_values(const std::string& path,
                                                           std::span<const std::string> joints) {
  const Result<std::string> text = read_table(path);
  if (!text) return text.error();
  return parse_joint_values(text.value(), path == "-" ? "stdin" : path, joints);
}

}  // namespace medial_vk
