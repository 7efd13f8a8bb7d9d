// The header of a PLY file: its elements and their properties.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "medial_vk/result.h"

namespace medial_vk {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

enum class PlyType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat, kDouble };
std::uint64_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  ///< Of the length of a list.
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of the property with one of these names; -1: none.
  int find(std::string_view property_name, std::string_view other_name = {}) const;
  /// The fewest bytes that one of these elements can take, with all lists empty.
  std::uint64_t smallest_size(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;
  std::uint64_t body = 0;       ///< Byte at which the first element starts.
  std::uint64_t body_line = 1;  ///< The line of that byte.
};

/// Errors: kInvalidMesh with the line.
Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& name);

}  // namespace medial_vk
