// Numbers as bytes of a file, least significant byte first, for any byte order of the machine.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <iterator>
#include <string>

namespace medial_vk {

template <class T>
void append_little_endian(std::string& out, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(std::begin(bytes), std::end(bytes));
  out.append(bytes, sizeof(T));
}

}  // namespace medial_vk
