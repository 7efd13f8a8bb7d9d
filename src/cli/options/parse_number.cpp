#include "cli/options/parse_number.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <limits>

namespace medial_vk::cli {
namespace {

Error number_error(std::string message) { return {ErrorCode::kUsage, std::move(message)}; }

template <class T>
bool parse_all(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

/// The power of 1024 of "g", "GB", "GiB" and the like; -1 for any other text.
int power_of_suffix(std::string suffix) {
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (suffix.empty()) return 2;  // A bare number is in MiB.
  const std::size_t power = std::string_view("bkmgt").find(suffix[0]);
  if (power == std::string_view::npos || power == 0) return -1;
  const std::string rest = suffix.substr(1);
  return rest.empty() || rest == "b" || rest == "ib" ? static_cast<int>(power) : -1;
}

}  // namespace

Result<double> parse_real(const std::string& text, const RealRange& range, const char* unit) {
  double value = 0;
  if (!parse_all(text, value)) return number_error(fmt::format("'{}' is not a number", text));
  // Written so that "nan" fails too.
  const bool inside = range.ends_included ? value >= range.least && value <= range.greatest
                                          : value > range.least && value < range.greatest;
  if (inside) return value;
  return number_error(fmt::format("{} is not {}between {:.5g} and {:.5g}{}", text,
                                  range.ends_included ? "" : "strictly ", range.least, range.greatest, unit));
}

Result<Length> parse_length(const std::string& text, double greatest, const char* unit) {
  if (!text.ends_with('%')) {
    const Result<double> value = parse_real(text, {0, greatest, true}, unit);
    if (!value) return value.error();
    return Length{value.value(), false};
  }
  const Result<double> percent = parse_real(text.substr(0, text.size() - 1), {0, 1000, true}, " % of the longest side");
  if (!percent) return percent.error();
  return Length{percent.value() / 100, true};
}

Result<std::uint64_t> parse_whole(const std::string& text, std::uint64_t least, std::uint64_t greatest,
                                  const char* unit) {
  std::uint64_t value = 0;
  std::int64_t negative = 0;
  const bool whole = parse_all(text, value);
  if (whole && value >= least && value <= greatest) return value;
  // Too many digits, or a minus sign in front of them: a whole number, but out of range.
  const bool only_digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
  if (!whole && !only_digits && !parse_all(text, negative)) {
    return number_error(fmt::format("'{}' is not a whole number", text));
  }
  return number_error(fmt::format("{} is not between {} and {}{}", text, least, greatest, unit));
}

Result<std::uint64_t> parse_memory(const std::string& text) {
  constexpr double kLeast = 64.0 * 1024 * 1024;
  constexpr double kGreatest = 1024.0 * 1024 * 1024 * 1024 * 4;
  const std::size_t digits = std::min(text.find_first_not_of("0123456789."), text.size());
  double value = 0;
  const int power = power_of_suffix(text.substr(digits));
  if (power < 0 || !parse_all(std::string_view(text).substr(0, digits), value)) {
    return number_error(fmt::format("'{}' is no amount of memory; write MiB as 512, or a suffix as in 2G", text));
  }
  for (int i = 0; i < power; ++i) value *= 1024.0;
  if (value >= kLeast && value <= kGreatest) return static_cast<std::uint64_t>(value);
  return number_error(fmt::format("{} is not between 64 MiB and 4 TiB", text));
}

}  // namespace medial_vk::cli
