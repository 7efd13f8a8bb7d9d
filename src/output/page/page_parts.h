// What all pages of the tool share: arrays of numbers, JSON and text as parts of an HTML file, and its marks.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace medial_vk::page {

/// An array of numbers for a page: little-endian bytes in base64, in an element of its own.
class Block {
 public:
  /// `bytes`: how many are expected.
  Block(std::string_view name, std::size_t bytes) : name_(name) { bytes_.reserve(bytes); }

  template <class T>
  void add(T value) {
    std::array<std::uint8_t, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  void write(std::string& page) const;

 private:
  std::string_view name_;
  std::vector<std::uint8_t> bytes_;
};

/// Appends JSON in an element, without "<", so that no text in it (a file name) can end the element.
void write_json(std::string& page, std::string_view name, std::string_view json);

/// A text as content of an HTML element: nothing in it begins another element, and bytes that are not UTF-8 are
/// replaced.
std::string text_in_html(std::string_view text);

/// A bundled page (cmake/BundlePage.cmake) without its two marks.
struct Template {
  std::string_view before_title, before_data, after_data;

  std::size_t size() const { return before_title.size() + before_data.size() + after_data.size(); }
};

/// `page` is not empty.
Template split(std::string_view page);

}  // namespace medial_vk::page
