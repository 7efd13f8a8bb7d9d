#include "platform/utf16.h"

#include <cstddef>
#include <cstdint>

namespace medial_vk::platform {
namespace {

constexpr std::uint32_t kReplacement = 0xfffd, kFirstBeyondUnits = 0x10000, kLastCharacter = 0x10ffff;

struct Decoded {
  std::uint32_t character = kReplacement;
  std::size_t bytes = 1;
};

/// The character at the beginning of `text`, which is not empty (Unicode 15, section 3.9, table 3-6).
Decoded decode(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return {first, 1};
  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc0 || first > 0xf7 || text.size() < length) return {};
  std::uint32_t character = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    character = character << 6 | (byte(i) & 0x3f);
  }
  constexpr std::uint32_t kFirstOfLength[] = {0x80, 0x800, kFirstBeyondUnits};
  if (character < kFirstOfLength[length - 2] || character > kLastCharacter) return {};
  return {character, length};
}

void append(std::string& utf8, std::uint32_t character) {
  if (character < 0x80) {
    utf8 += static_cast<char>(character);
    return;
  }
  const int following = character < 0x800 ? 1 : character < kFirstBeyondUnits ? 2 : 3;
  utf8 += static_cast<char>((0xff00u >> (following + 1) & 0xff) | character >> 6 * following);
  for (int i = following - 1; i >= 0; --i) utf8 += static_cast<char>(0x80 | (character >> 6 * i & 0x3f));
}

bool is_first_half(char16_t unit) { return unit >= 0xd800 && unit < 0xdc00; }
bool is_second_half(char16_t unit) { return unit >= 0xdc00 && unit < 0xe000; }

}  // namespace

std::u16string utf16_of(std::string_view utf8) {
  std::u16string utf16;
  utf16.reserve(utf8.size());
  while (!utf8.empty()) {
    const Decoded next = decode(utf8);
    utf8.remove_prefix(next.bytes);
    if (next.character < kFirstBeyondUnits) {
      utf16 += static_cast<char16_t>(next.character);
      continue;
    }
    const std::uint32_t rest = next.character - kFirstBeyondUnits;
    utf16 += static_cast<char16_t>(0xd800 + (rest >> 10));
    utf16 += static_cast<char16_t>(0xdc00 + (rest & 0x3ff));
  }
  return utf16;
}

std::string utf8_of(std::u16string_view utf16) {
  std::string utf8;
  utf8.reserve(utf16.size());
  for (std::size_t i = 0; i < utf16.size(); ++i) {
    std::uint32_t character = utf16[i];
    if (is_first_half(utf16[i]) && i + 1 < utf16.size() && is_second_half(utf16[i + 1])) {
      character = kFirstBeyondUnits + ((character - 0xd800) << 10) + (utf16[++i] - 0xdc00u);
    }
    append(utf8, character);
  }
  return utf8;
}

}  // namespace medial_vk::platform
