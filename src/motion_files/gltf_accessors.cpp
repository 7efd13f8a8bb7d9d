#include "motion_files/gltf_accessors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

namespace medial_vk {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kFreeValues = 1u << 20;
constexpr std::uint64_t kValuesPerByte = 16;
constexpr std::uint64_t kMostElements = 0xfffffffe;

enum ComponentType : std::uint64_t {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126,
};

std::uint64_t bytes_of_component(std::uint64_t type) {
  switch (type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      throw GltfFault{fmt::format("an accessor has the component type {}, which glTF does not have", type)};
  }
}

template <class T>
double value_as(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);  // glTF is little-endian, as every machine that runs this program
  return static_cast<double>(value);
}

double raw_value(std::uint64_t type, const char* bytes) {
  switch (type) {
    case kByte:
      return value_as<std::int8_t>(bytes);
    case kUnsignedByte:
      return value_as<std::uint8_t>(bytes);
    case kShort:
      return value_as<std::int16_t>(bytes);
    case kUnsignedShort:
      return value_as<std::uint16_t>(bytes);
    case kUnsignedInt:
      return value_as<std::uint32_t>(bytes);
    default:
      return value_as<float>(bytes);
  }
}

/// A normalised integer as a number (glTF 2.0, 3.6.2.2).
double normalized_value(std::uint64_t type, double value) {
  switch (type) {
    case kByte:
      return std::max(value / 127, -1.0);
    case kUnsignedByte:
      return value / 255;
    case kShort:
      return std::max(value / 32767, -1.0);
    case kUnsignedShort:
      return value / 65535;
    default:
      return value;
  }
}

std::uint64_t width_of(const std::string& type) {
  constexpr std::pair<std::string_view, std::uint64_t> kTypes[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  for (const auto& [name, width] : kTypes) {
    if (type == name) return width;
  }
  return 0;
}

bool flag_in(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_boolean() && at->get<bool>();
}

}  // namespace

/// Elements in a buffer, which has the bytes of all of them.
struct GltfAccessors::View {
  const char* bytes = nullptr;
  std::uint64_t count = 0, width = 0, stride = 0, type = 0;
};

struct GltfAccessors::Sparse {
  View indices, values;
};

/// The elements that `object`, an accessor or a part of a sparse one, refers to.
GltfAccessors::View GltfAccessors::view(const Json& object, const char* key_of_view, std::uint64_t count,
                                        std::uint64_t width, std::uint64_t component_type, bool has_stride) {
  const Json& description = document_.item("bufferViews", required_number_in(object, key_of_view));
  const std::string_view buffer = document_.buffer(required_number_in(description, "buffer"));
  const std::uint64_t first = whole_number_in(description, "byteOffset").value_or(0);
  const std::uint64_t length = required_number_in(description, "byteLength");
  if (first > buffer.size() || length > buffer.size() - first) throw GltfFault{"a buffer view ends behind its buffer"};
  const std::uint64_t offset = whole_number_in(object, "byteOffset").value_or(0);
  const std::uint64_t element = width * bytes_of_component(component_type);
  const std::uint64_t stride = has_stride ? whole_number_in(description, "byteStride").value_or(element) : element;
  if (stride < element || stride > 252 + element) throw GltfFault{"the stride of a buffer view is out of range"};
  // count < 2^32 and stride < 2^9, so that no product overflows.
  const std::uint64_t needed = count == 0 ? 0 : (count - 1) * stride + element;
  if (offset > length || needed > length - offset) throw GltfFault{"an accessor ends behind its buffer view"};
  return {buffer.data() + first + offset, count, width, stride, component_type};
}

void GltfAccessors::take_from_budget(std::uint64_t count, std::uint64_t width) {
  const std::uint64_t most = kFreeValues + kValuesPerByte * document_.size();
  used_ += count * width;  // at most 2^36, a few times
  if (used_ > most) {
    throw GltfFault{fmt::format("its accessors have more than {} values, the most that are read of {} bytes", most,
                                document_.size())};
  }
}

void GltfAccessors::read_values(const View& view, bool is_normalized, std::vector<double>& values) const {
  const std::uint64_t size = bytes_of_component(view.type);
  values.resize(view.count * view.width);
  for (std::uint64_t i = 0; i < view.count; ++i) {
    const char* element = view.bytes + i * view.stride;
    for (std::uint64_t k = 0; k < view.width; ++k) {
      const double raw = raw_value(view.type, element + k * size);
      if (!std::isfinite(raw)) throw GltfFault{"a number of an accessor is not finite"};
      values[i * view.width + k] = is_normalized ? normalized_value(view.type, raw) : raw;
    }
  }
}

/// Some elements with values of their own (glTF 2.0, 3.6.2.3).
void GltfAccessors::replace(const Sparse& sparse, bool is_normalized, const GltfArray& array,
                            std::vector<double>& values) const {
  std::vector<double> at, with;
  read_values(sparse.indices, false, at);
  read_values(sparse.values, is_normalized, with);
  for (std::uint64_t i = 0; i < at.size(); ++i) {
    if (!(at[i] >= 0 && at[i] < static_cast<double>(array.count))) {
      throw GltfFault{"a sparse accessor replaces an element that is not there"};
    }
    const auto element = static_cast<std::uint64_t>(at[i]);
    for (std::uint64_t k = 0; k < array.width; ++k) values[element * array.width + k] = with[i * array.width + k];
  }
}

GltfAccessors::Sparse GltfAccessors::sparse_of(const Json& accessor, std::uint64_t width, std::uint64_t type) {
  const Json& sparse = list_in(accessor, "sparse");
  if (sparse.empty()) return {};
  const std::uint64_t count = required_number_in(sparse, "count");
  if (count > kMostElements) throw GltfFault{"an accessor has too many elements"};
  const Json& indices = list_in(sparse, "indices");
  return {view(indices, "bufferView", count, 1, required_number_in(indices, "componentType"), false),
          view(list_in(sparse, "values"), "bufferView", count, width, type, false)};
}

GltfArray GltfAccessors::read(std::uint64_t accessor, std::uint64_t width) {
  if (const auto known = arrays_.find(accessor); known != arrays_.end()) {
    if (known->second.width != width) throw GltfFault{fmt::format("accessor {} has the wrong type", accessor)};
    return known->second;
  }
  const Json& description = document_.item("accessors", accessor);
  if (width_of(text_in(description, "type")) != width) {
    throw GltfFault{fmt::format("accessor {} has the wrong type", accessor)};
  }
  const std::uint64_t type = required_number_in(description, "componentType");
  const bool is_normalized = flag_in(description, "normalized");
  GltfArray array = {required_number_in(description, "count"), width, nullptr};
  // Columns of matrices of short components are padded to four bytes, which only other accessors than ours use.
  if (width == 16 && type != kFloat) throw GltfFault{fmt::format("accessor {} has the wrong type", accessor)};
  if (array.count > kMostElements) throw GltfFault{"an accessor has too many elements"};
  // The views first: they load the buffers, on whose length the budget depends.
  const bool has_view = description.contains("bufferView");
  const View elements = has_view ? view(description, "bufferView", array.count, width, type, true) : View();
  const Sparse sparse = sparse_of(description, width, type);
  take_from_budget(array.count, width);
  take_from_budget(sparse.values.count, width + 1);
  std::vector<double> values;
  if (has_view) read_values(elements, is_normalized, values);
  if (!has_view) values.resize(array.count * width);  // zeros (glTF 2.0, 5.1.1)
  if (sparse.values.count > 0) replace(sparse, is_normalized, array, values);
  array.values = std::make_shared<const std::vector<double>>(std::move(values));
  return arrays_.emplace(accessor, std::move(array)).first->second;
}

}  // namespace medial_vk
