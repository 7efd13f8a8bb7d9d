// UTF-8 and the UTF-16 of Windows, whose names of files may hold any sequence of 16-bit units.
#pragma once

#include <string>
#include <string_view>

namespace medial_vk::platform {

/// Neither fails. A surrogate without its other half becomes three bytes as any other unit would (WTF-8,
/// simonsapin.github.io/wtf-8), and back, so that a name of UTF-16 that is not well-formed stays the same name. A byte
/// that belongs to no character becomes U+FFFD, and with it a name that no file has.
std::u16string utf16_of(std::string_view utf8);
std::string utf8_of(std::u16string_view utf16);

}  // namespace medial_vk::platform
