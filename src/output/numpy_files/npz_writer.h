// NumPy arrays as a file: a zip of .npy files, as numpy.savez writes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "output/atomic_files/little_endian.h"
#include "output/numpy_files/zip_archive.h"

namespace medial_vk {

/// The name of a type of numbers in a .npy.
template <class T>
constexpr const char* kNumpyType = nullptr;
template <>
inline constexpr const char* kNumpyType<double> = "<f8";
template <>
inline constexpr const char* kNumpyType<float> = "<f4";
template <>
inline constexpr const char* kNumpyType<std::int32_t> = "<i4";
template <>
inline constexpr const char* kNumpyType<std::uint32_t> = "<u4";
template <>
inline constexpr const char* kNumpyType<std::uint64_t> = "<u8";

/// Collects arrays. They are stored, not compressed: the bytes of a compressed archive would depend on the installed
/// zlib. The same arrays give the same bytes.
class NpzWriter {
 public:
  /// The lengths along the axes; none: a single number.
  using Shape = std::vector<std::size_t>;

  /// An array of `type`, such as "<f8", from its little-endian bytes, the last axis fastest.
  void add(const char* name, const std::string& type, const Shape& shape, const std::string& bytes);

  template <class T>
  void number(const char* name, T value) {
    numbers<T>(name, {}, {&value, 1});
  }

  /// Precondition: `values` has as many numbers as the shape.
  template <class T>
  void numbers(const char* name, const Shape& shape, std::span<const T> values) {
    std::string bytes;
    bytes.reserve(values.size() * sizeof(T));
    for (const T value : values) append_little_endian(bytes, value);
    add(name, kNumpyType<T>, shape, bytes);
  }

  /// ASCII only, which NumPy stores as four bytes per letter.
  void text(const char* name, const std::string& value);

  /// The bytes of the file. Error: kOutOfMemory.
  Result<std::string> finish() const { return make_zip(members_); }

 private:
  std::vector<ZipMember> members_;
};

}  // namespace medial_vk
