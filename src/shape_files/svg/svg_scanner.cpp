#include "shape_files/svg/svg_scanner.h"

#include <fmt/format.h>

#include "base/quoted.h"
#include "input/text_scanner.h"

namespace medial_vk {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::size_t digits_from(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// The length of the number at the beginning of the text, 0 if there is none.
std::size_t length_of_number(std::string_view text) {
  const std::size_t sign = !text.empty() && (text[0] == '+' || text[0] == '-') ? 1 : 0;
  const std::size_t whole = digits_from(text, sign);
  std::size_t end = whole, digits = whole - sign;
  if (end < text.size() && text[end] == '.') {
    const std::size_t fraction = digits_from(text, end + 1);
    digits += fraction - end - 1;
    end = fraction;
  }
  if (digits == 0) return 0;
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t power = end + 1;
    if (power < text.size() && (text[power] == '+' || text[power] == '-')) ++power;
    const std::size_t last = digits_from(text, power);
    if (last > power) end = last;  // otherwise it begins a unit, as in "1em"
  }
  return end;
}

}  // namespace

bool is_svg_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }

std::string_view without_svg_blanks(std::string_view text) {
  while (!text.empty() && is_svg_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_svg_blank(text.back())) text.remove_suffix(1);
  return text;
}

void SvgScanner::skip_blanks() {
  while (!rest_.empty() && is_svg_blank(rest_.front())) rest_.remove_prefix(1);
}

void SvgScanner::skip_separator() {
  skip_blanks();
  accept(',');
}

void SvgScanner::step() {
  rest_.remove_prefix(1);
  skip_blanks();
}

bool SvgScanner::accept(char c) {
  if (next() != c || at_end()) return false;
  step();
  return true;
}

bool SvgScanner::starts_number() const { return length_of_number(rest_) > 0; }

double SvgScanner::number_before_unit() {
  const std::size_t length = length_of_number(rest_);
  if (length == 0) {
    if (at_end()) throw SvgFault{"it ends where a number is expected"};
    throw SvgFault{fmt::format("{} is not a number", quoted(rest_))};
  }
  double value = 0;
  std::string_view why;
  const std::string_view word = rest_.substr(0, length);
  if (!parse_coordinate(word, value, why)) throw SvgFault{fmt::format("{} {}", quoted(word), why)};
  rest_.remove_prefix(length);
  return value;
}

double SvgScanner::number() {
  const double value = number_before_unit();
  skip_separator();
  return value;
}

bool SvgScanner::flag() {
  const char c = next();
  if (c != '0' && c != '1') throw SvgFault{fmt::format("{} is not a flag of an arc, 0 or 1", quoted(rest_))};
  rest_.remove_prefix(1);
  skip_separator();
  return c == '1';
}

std::string_view SvgScanner::letters() {
  std::size_t length = 0;
  while (length < rest_.size() && (is_letter(rest_[length]) || rest_[length] == '%')) ++length;
  const std::string_view word = rest_.substr(0, length);
  rest_.remove_prefix(length);
  return word;
}

std::vector<double> svg_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (SvgScanner scanner(text); !scanner.at_end();) numbers.push_back(scanner.number());
  return numbers;
}

}  // namespace medial_vk
