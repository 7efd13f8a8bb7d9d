#include "output/sphere_files/float_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace medial_vk {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_plain(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; }

/// The words that YAML 1.1 reads as a truth value or as null, in any case.
bool has_meaning(std::string_view word) {
  constexpr std::array<std::string_view, 9> kWords = {"y", "n", "yes", "no", "on", "off", "true", "false", "null"};
  return std::ranges::any_of(kWords, [&](std::string_view known) {
    return std::ranges::equal(word, known,
                              [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
  });
}

}  // namespace

std::string float_text(double x) {
  std::string text = fmt::format("{}", x);
  const std::size_t exponent = text.find('e');
  if (text.find('.') == std::string::npos) text.insert(std::min(exponent, text.size()), ".0");
  return text;
}

std::string yaml_word(std::string_view word) {
  const bool plain = !word.empty() && (is_letter(word[0]) || word[0] == '_') && std::ranges::all_of(word, is_plain) &&
                     !has_meaning(word);
  if (plain) return std::string(word);
  std::string quoted = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') {
      quoted += fmt::format("\\{}", c);
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      quoted += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

}  // namespace medial_vk
