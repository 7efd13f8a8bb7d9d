#include "output/page/base64.h"

#include <string_view>

namespace medial_vk::page {

void append_base64(std::string& out, std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::size_t i = 0;
  for (; i + 3 <= bytes.size(); i += 3) {
    const std::uint32_t word = bytes[i] << 16 | bytes[i + 1] << 8 | bytes[i + 2];
    for (const unsigned shift : {18u, 12u, 6u, 0u}) out += kDigits[word >> shift & 63];
  }
  const std::size_t left = bytes.size() - i;
  if (left == 0) return;
  const std::uint32_t word = bytes[i] << 16 | (left == 2 ? bytes[i + 1] << 8 : 0);
  out += kDigits[word >> 18];
  out += kDigits[word >> 12 & 63];
  out += left == 2 ? kDigits[word >> 6 & 63] : '=';
  out += '=';
}

}  // namespace medial_vk::page
