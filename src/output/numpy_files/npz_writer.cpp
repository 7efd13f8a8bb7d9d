#include "output/numpy_files/npz_writer.h"

#include <fmt/format.h>

namespace medial_vk {
namespace {

/// In the notation of Python: "()", "(3,)", "(3, 2)".
std::string shape_text(const NpzWriter::Shape& shape) {
  std::string text;
  for (const std::size_t length : shape) text += fmt::format("{}{}", text.empty() ? "" : ", ", length);
  return fmt::format("({}{})", text, shape.size() == 1 ? "," : "");
}

/// Format version 1.0 of NumPy's NEP 1: a dictionary in the notation of Python, padded so that the numbers are aligned.
std::string npy_header(const std::string& type, const NpzWriter::Shape& shape) {
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kPrefix = 10;
  std::string words = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': {}, }}", type, shape_text(shape));
  words.append(kAlignment - (kPrefix + words.size() + 1) % kAlignment, ' ');
  words += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  append_little_endian(out, static_cast<std::uint16_t>(words.size()));
  return out + words;
}

}  // namespace

void NpzWriter::add(const char* name, const std::string& type, const Shape& shape, const std::string& bytes) {
  members_.push_back({fmt::format("{}.npy", name), npy_header(type, shape) + bytes});
}

void NpzWriter::text(const char* name, const std::string& value) {
  std::string bytes;
  for (const char letter : value) append_little_endian(bytes, static_cast<std::uint32_t>(letter));
  add(name, fmt::format("<U{}", value.size()), {}, bytes);
}

}  // namespace medial_vk
