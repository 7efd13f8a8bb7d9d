#include "fuzz/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

namespace medial_vk::fuzz {

std::vector<std::string> arguments(std::string_view text) {
  std::vector<std::string> words;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find_first_of(std::string_view("\n\0", 2)));
    words.emplace_back(word);
    text.remove_prefix(std::min(word.size() + 1, text.size()));
  }
  return words;
}

bool is_sample(const std::vector<std::string>& arguments) {
  return std::hash<std::string>()(fmt::format("{}", fmt::join(arguments, " "))) % 64 == 0;
}

}  // namespace medial_vk::fuzz
