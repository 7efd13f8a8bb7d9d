// Bytes as text (RFC 4648, Section 4).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace medial_vk::page {

/// Appends the bytes as base64, padded.
void append_base64(std::string& out, std::span<const std::uint8_t> bytes);

}  // namespace medial_vk::page
