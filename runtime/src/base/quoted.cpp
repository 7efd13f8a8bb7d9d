#include "base/quoted.h"

namespace medial_vk {

std::string quoted(std::string_view word) {
  constexpr std::size_t kLongest = 40;
  std::string text = "\"";
  for (const char c : word.substr(0, kLongest)) text += c >= 0x20 && c < 0x7f ? c : '?';
  if (word.size() > kLongest) text += "...";
  return text + '"';
}

}  // namespace medial_vk
