#include "motion_files/frame_patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "base/quoted.h"
#include "input/text_scanner.h"
#include "motion_files/mesh_motion.h"
#include "platform/files.h"
#include "platform/paths.h"

namespace medial_vk {
namespace {

constexpr std::size_t kMostDigits = 18;  // such numbers fit 64 bits

Error usage_error(const std::string& pattern, std::string_view what) {
  return {ErrorCode::kUsage, fmt::format("{} {}", medial_vk::quoted(pattern), what)};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The folder with its last slash, and the name.
std::pair<std::string, std::string> split(const std::string& path) {
  const std::size_t slash = path.find_last_of(platform::kFolderSigns);
  if (slash == std::string::npos) return {"", path};
  return {path.substr(0, slash + 1), path.substr(slash + 1)};
}

/// Words around a number of at least `digits` digits, with zeros before it.
struct NumberPattern {
  std::string before, after;
  std::size_t digits = 0;  // 0: no number has been found yet

  std::string name_of(std::uint64_t number) const {
    return before + fmt::format("{:0{}}", number, static_cast<int>(digits)) + after;
  }

  /// The number of a name that name_of() makes.
  std::optional<std::uint64_t> number_of(std::string_view name) const {
    if (name.size() < before.size() + after.size() + digits || !name.starts_with(before) || !name.ends_with(after)) {
      return {};
    }
    const std::string_view word = name.substr(before.size(), name.size() - before.size() - after.size());
    if (word.size() > std::max(digits, kMostDigits) || !std::ranges::all_of(word, is_digit)) return {};
    std::uint64_t number = 0;
    if (std::from_chars(word.data(), word.data() + word.size(), number).ec != std::errc()) return {};
    if (word.size() > digits && word.front() == '0') return {};
    return number;
  }
};

/// Takes a directive of printf() that begins behind the percent sign at `at`: d, or 0, a width and d.
bool take_directive(std::string_view name, std::size_t& at, std::size_t& digits) {
  digits = 1;
  if (at < name.size() && name[at] == '0') {
    const std::size_t first = ++at;
    while (at < name.size() && is_digit(name[at])) ++at;
    const auto [end, error] = std::from_chars(name.data() + first, name.data() + at, digits);
    if (error != std::errc() || digits == 0 || digits > kMostDigits) return false;
  }
  return at < name.size() && name[at++] == 'd';
}

Result<NumberPattern> parse_number_pattern(const std::string& pattern, const std::string& name) {
  NumberPattern parsed;
  for (std::size_t at = 0; at < name.size();) {
    std::string& words = parsed.digits == 0 ? parsed.before : parsed.after;
    const bool is_sign = name[at] == '%' && at + 1 < name.size() && name[at + 1] == '%';
    if (is_sign || (name[at] != '%' && name[at] != '#')) {
      words += name[at];
      at += is_sign ? 2 : 1;
      continue;
    }
    std::size_t digits = 0;
    if (name[at] == '#') {
      for (; at < name.size() && name[at] == '#'; ++at) ++digits;
      if (digits > kMostDigits) return usage_error(pattern, fmt::format("has more than {} digits", kMostDigits));
    } else if (!take_directive(name, ++at, digits)) {
      return usage_error(pattern,
                         "is no pattern of files: behind % there may be d, or 0 with a width of 1 to 18 and d");
    }
    if (parsed.digits > 0) return usage_error(pattern, "is no pattern of files: it has more than one number");
    parsed.digits = digits;
  }
  return parsed;
}

Error too_many(const std::string& pattern) {
  return usage_error(pattern, fmt::format("stands for more than {} files", kMostFrames));
}

/// Calls visit(name) for all files of a folder until it returns false.
template <class Visit>
Status visit_names(const std::string& pattern, const std::string& folder, Visit visit) {
  std::error_code error;
  std::filesystem::directory_iterator at(platform::path_of(folder.empty() ? "." : folder), error), end;
  for (; !error && at != end; at.increment(error)) {
    if (!visit(platform::text_of(at->path().filename()))) return too_many(pattern);
  }
  if (error)
    return file_error(pattern, fmt::format("its folder cannot be read: {}", error.default_error_condition().message()));
  return {};
}

Result<std::vector<std::string>> numbered_files(const std::string& pattern, const std::string& folder,
                                                const NumberPattern& numbers) {
  std::vector<std::uint64_t> found;
  const Status visited = visit_names(pattern, folder, [&](const std::string& name) {
    if (const std::optional<std::uint64_t> number = numbers.number_of(name)) found.push_back(*number);
    return found.size() <= kMostFrames;
  });
  if (!visited) return visited.error();
  if (found.empty()) return file_error(pattern, "there is no such file");
  std::ranges::sort(found);
  std::vector<std::string> files;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] != found.front() + i) {
      return file_error(
          folder + numbers.name_of(found.front() + i),
          fmt::format("is missing, between the first and the last file of {}", medial_vk::quoted(pattern)));
    }
    files.push_back(folder + numbers.name_of(found[i]));
  }
  return files;
}

Result<std::vector<std::string>> matching_files(const std::string& pattern, const std::string& folder,
                                                const std::string& name) {
  std::vector<std::string> files;
  const Status visited = visit_names(pattern, folder, [&](const std::string& file) {
    if (platform::matches_pattern(file, name)) files.push_back(folder + file);
    return files.size() <= kMostFrames;
  });
  if (!visited) return visited.error();
  if (files.empty()) return file_error(pattern, "there is no such file");
  std::ranges::sort(files, [](const auto& a, const auto& b) { return compare_naturally(a, b) < 0; });
  return files;
}

bool is_there(const std::string& path) {
  std::error_code error;
  return std::filesystem::exists(platform::path_of(path), error);
}

}  // namespace

int compare_naturally(std::string_view a, std::string_view b) {
  const std::string_view all_a = a, all_b = b;
  while (!a.empty() && !b.empty()) {
    if (!is_digit(a.front()) || !is_digit(b.front())) {
      if (a.front() != b.front()) {
        return static_cast<unsigned char>(a.front()) < static_cast<unsigned char>(b.front()) ? -1 : 1;
      }
      a.remove_prefix(1);
      b.remove_prefix(1);
      continue;
    }
    const auto take_number = [](std::string_view& text) {
      const std::size_t size = std::min(text.find_first_not_of("0123456789"), text.size());
      std::string_view number = text.substr(0, size);
      text.remove_prefix(size);
      number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
      return number;
    };
    const std::string_view first = take_number(a), second = take_number(b);
    if (first.size() != second.size()) return first.size() < second.size() ? -1 : 1;
    if (const int order = first.compare(second); order != 0) return order;
  }
  if (a.empty() != b.empty()) return a.empty() ? -1 : 1;
  return all_a.compare(all_b);  // they differ in zeros before numbers, or not at all
}

bool is_frame_pattern(const std::string& path) {
  return split(path).second.find_first_of("%#*?[") != std::string::npos && !is_there(path);
}

Result<std::vector<std::string>> files_of_pattern(const std::string& pattern) {
  const auto [folder, name] = split(pattern);
  if (folder.find_first_of("*?") != std::string::npos) {
    return usage_error(pattern, "is no pattern of files: * and ? stand in the name of a file, not of a folder");
  }
  const Result<NumberPattern> numbers = parse_number_pattern(pattern, name);
  const bool has_number = numbers && numbers.value().digits > 0;
  // Beside a number, brackets are a part of the name.
  const bool has_wildcard = name.find_first_of(has_number ? "*?" : "*?[") != std::string::npos;
  if (!has_wildcard && !numbers) return numbers.error();
  if (!has_wildcard) {
    if (!has_number) return usage_error(pattern, "is no pattern of files: it has no number, *, ? or [...]");
    return numbered_files(pattern, folder, numbers.value());
  }
  if (has_number) {
    return usage_error(pattern, "is no pattern of files: it has a number and a wildcard");
  }
  return matching_files(pattern, folder, name);
}

}  // namespace medial_vk
