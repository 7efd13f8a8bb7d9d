// The accessors of a glTF 2.0 document: arrays of numbers in its buffers.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "motion_files/gltf_document.h"

namespace medial_vk {

/// Values of an accessor, shared by all that use it.
struct GltfArray {
  std::uint64_t count = 0;  ///< Elements.
  std::uint64_t width = 0;  ///< Values of an element.
  std::shared_ptr<const std::vector<double>> values;

  const double* operator[](std::uint64_t element) const { return values->data() + element * width; }
};

class GltfAccessors {
 public:
  explicit GltfAccessors(GltfDocument& document) : document_(document) {}

  /// The values of an accessor of one of these widths (1: SCALAR, 2 to 4: VEC2 to VEC4, 16: MAT4, column after column),
  /// finite. Normalised integers are numbers from -1 or 0 to 1. All arrays together have at most 2^20 values, and 16
  /// for each byte of the file: accessors of a small file can declare any size, and cover the same bytes many times.
  GltfArray read(std::uint64_t accessor, std::uint64_t width);

 private:
  struct View;
  struct Sparse;
  View view(const nlohmann::json& object, const char* key_of_view, std::uint64_t count, std::uint64_t width,
            std::uint64_t component_type, bool has_stride);
  void read_values(const View& view, bool is_normalized, std::vector<double>& values) const;
  Sparse sparse_of(const nlohmann::json& accessor, std::uint64_t width, std::uint64_t type);
  void replace(const Sparse& sparse, bool is_normalized, const GltfArray& array, std::vector<double>& values) const;
  void take_from_budget(std::uint64_t count, std::uint64_t width);

  GltfDocument& document_;
  std::map<std::uint64_t, GltfArray> arrays_;
  std::uint64_t used_ = 0;
};

}  // namespace medial_vk
