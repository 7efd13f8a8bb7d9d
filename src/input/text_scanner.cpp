#include "input/text_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace medial_vk {
namespace {

/// For a number that std::from_chars found out of range: too small (true) or too large (false). The position of its
/// first nonzero digit decides; any number near 1 was in range.
bool is_underflow(std::string_view word) {
  std::int64_t magnitude = 0;  // decimal exponent of the first non-zero digit, without the written exponent
  bool in_fraction = false, found = false;
  std::size_t i = 0;
  for (; i < word.size() && word[i] != 'e' && word[i] != 'E'; ++i) {
    if (word[i] == '.') {
      in_fraction = true;
    } else if (word[i] >= '0' && word[i] <= '9') {
      if (!found && word[i] != '0') {
        found = true;
        if (in_fraction)
          --magnitude;
        else
          magnitude = 0;
      } else if (found && !in_fraction) {
        ++magnitude;
      } else if (!found && in_fraction) {
        --magnitude;
      }
    }
  }
  if (!found) return true;
  bool negative = false;
  std::int64_t exponent = 0;
  for (++i; i < word.size(); ++i) {
    if (word[i] == '-') negative = true;
    if (word[i] >= '0' && word[i] <= '9') exponent = std::min<std::int64_t>(exponent * 10 + (word[i] - '0'), 1ll << 40);
  }
  return magnitude + (negative ? -exponent : exponent) < 0;
}

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

}  // namespace

Error line_error(const std::string& name, std::uint64_t line, std::string_view what) {
  return {ErrorCode::kInvalidMesh, fmt::format("{}:{}: {}", name, line, what)};
}

Error file_error(const std::string& name, std::string_view what) {
  return {ErrorCode::kInvalidMesh, fmt::format("{}: {}", name, what)};
}

bool parse_coordinate(std::string_view word, double& value, std::string_view& why) {
  word = without_plus(word);
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (stop != word.data() + word.size() || error == std::errc::invalid_argument) {
    why = "is not a number";
    return false;
  }
  if (error == std::errc::result_out_of_range) {
    why = "is beyond the range of a double";
    value = 0;
    return is_underflow(word);
  }
  why = "is not finite";
  return std::isfinite(value);
}

bool parse_integer(std::string_view word, std::int64_t& value) {
  word = without_plus(word);
  const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && stop == word.data() + word.size() && !word.empty();
}

void TextScanner::step_over_line_end() {
  if (*at_ == '\r' && at_ + 1 < end_ && at_[1] == '\n') ++at_;
  ++at_;
  ++line_;
}

std::string_view TextScanner::word() {
  for (;;) {
    while (at_ < end_ && is_blank(*at_)) ++at_;
    if (at_ == end_ || at_line_end()) return {};
    if (comment_ != 0 && *at_ == comment_) {
      while (at_ < end_ && !at_line_end()) ++at_;
      return {};
    }
    if (!continuation_ || *at_ != '\\' || at_ + 1 == end_ || (at_[1] != '\n' && at_[1] != '\r')) break;
    ++at_;
    step_over_line_end();
  }
  const char* const start = at_;
  while (at_ < end_ && !is_blank(*at_) && !at_line_end() && (comment_ == 0 || *at_ != comment_)) {
    if (continuation_ && *at_ == '\\' && at_ + 1 < end_ && (at_[1] == '\n' || at_[1] == '\r')) break;
    ++at_;
  }
  return {start, static_cast<std::size_t>(at_ - start)};
}

std::string_view TextScanner::word_across_lines() {
  for (;;) {
    const std::string_view next = word();
    if (!next.empty()) return next;
    if (at_ == end_) return {};
    step_over_line_end();
  }
}

bool TextScanner::next_line() {
  while (at_ < end_ && !at_line_end()) ++at_;
  if (at_ == end_) return false;
  step_over_line_end();
  return at_ < end_;
}

}  // namespace medial_vk
