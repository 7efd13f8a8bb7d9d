#include "motion_files/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/quoted.h"
#include "input/read_mesh.h"
#include "scene_files/files_of_folder.h"

namespace medial_vk {
namespace {

using Json = nlohmann::json;

const Json kNoMembers = Json::object();
const Json kNoElements = Json::array();

std::uint32_t little_endian_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
  return value;
}

/// The bytes of base64, of either alphabet; false for another character.
bool decode_base64(std::string_view text, std::string& bytes) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  bytes.clear();
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    std::uint32_t digit = 0;
    if (c >= 'A' && c <= 'Z')
      digit = static_cast<std::uint32_t>(c - 'A');
    else if (c >= 'a' && c <= 'z')
      digit = static_cast<std::uint32_t>(c - 'a' + 26);
    else if (c >= '0' && c <= '9')
      digit = static_cast<std::uint32_t>(c - '0' + 52);
    else if (c == '+' || c == '-')
      digit = 62;
    else if (c == '/' || c == '_')
      digit = 63;
    else
      return false;
    bits = bits << 6 | digit;
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return true;
}

/// Extensions that change neither the places of vertices nor how they are stored.
bool is_harmless(std::string_view extension) {
  constexpr std::array<std::string_view, 6> kStarts = {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                                                       "KHR_lights_",    "EXT_lights_",  "KHR_xmp"};
  return extension == "KHR_mesh_quantization" ||
         std::ranges::any_of(kStarts, [&](std::string_view start) { return extension.starts_with(start); });
}

}  // namespace

std::uint64_t whole_number_of_json(const Json& value) {
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  throw GltfFault{"an index or a count is no whole number"};
}

std::optional<std::uint64_t> whole_number_in(const Json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end()) return {};
  return whole_number_of_json(*at);
}

std::uint64_t required_number_in(const Json& object, const char* key) {
  if (const std::optional<std::uint64_t> number = whole_number_in(object, key)) return *number;
  throw GltfFault{fmt::format("a member {} is missing", medial_vk::quoted(key))};
}

std::string text_in(const Json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? at->get_ref<const std::string&>() : std::string();
}

const Json& list_in(const Json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end()) return kNoElements;
  if (!at->is_structured()) throw GltfFault{fmt::format("a member {} is no list", medial_vk::quoted(key))};
  return *at;
}

double number_of_json(const Json& value) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!std::isfinite(number)) throw GltfFault{"a number is missing or not finite"};
  return number;
}

GltfDocument::GltfDocument(std::string bytes, const std::string& path) : bytes_(std::move(bytes)) {
  if (!path.empty()) folder_ = folder_of_scene(path);
  size_ = bytes_.size();
  text_ = bytes_;
  if (text_.starts_with("glTF")) text_ = split_glb();
  if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  root_ = Json::parse(text_.begin(), text_.end(), nullptr, false);
  if (!root_.is_object()) throw GltfFault{"its JSON is broken"};
  const std::string version = text_in(member("asset"), "version");
  if (!version.starts_with("2.")) throw GltfFault{fmt::format("its version is {}, not 2", medial_vk::quoted(version))};
  check_extensions();
}

/// The text of a GLB; the next chunk becomes `binary_`.
std::string_view GltfDocument::split_glb() {
  const std::string_view all = bytes_;
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (all.size() < kHeader + kChunkHeader) throw GltfFault{"it ends in the header of a GLB"};
  const std::uint32_t version = little_endian_at(all, 4);
  if (version != 2) throw GltfFault{fmt::format("the version of this GLB is {}, not 2", version)};
  std::string_view text;
  int index = 0;
  for (std::size_t at = kHeader; at + kChunkHeader <= all.size() && index < 2; ++index) {
    const std::uint64_t length = little_endian_at(all, at);
    const std::string_view type = all.substr(at + 4, 4);
    at += kChunkHeader;
    if (length > all.size() - at) throw GltfFault{"it ends in a chunk of the GLB"};
    if (index == 0 && type != "JSON") throw GltfFault{"the first chunk of the GLB is not its JSON"};
    if (index == 0) text = all.substr(at, length);
    if (index == 1 && type == std::string_view("BIN\0", 4)) binary_ = all.substr(at, length);
    at += length;
  }
  return text;
}

void GltfDocument::check_extensions() const {
  for (const Json& extension : list_in(root_, "extensionsRequired")) {
    const std::string name = extension.is_string() ? extension.get<std::string>() : "?";
    if (!is_harmless(name)) {
      throw GltfFault{fmt::format("it needs the extension {}, which is not supported", medial_vk::quoted(name))};
    }
  }
}

std::uint64_t GltfDocument::count(const char* list) const { return list_in(root_, list).size(); }

const Json& GltfDocument::item(const char* list, std::uint64_t index) const {
  const Json& all = list_in(root_, list);
  if (!all.is_array() || index >= all.size() || !all[index].is_object()) {
    throw GltfFault{fmt::format("element {} of {} is not there", index, medial_vk::quoted(list))};
  }
  return all[index];
}

const Json& GltfDocument::member(const char* key) const {
  const auto at = root_.find(key);
  return at != root_.end() && at->is_object() ? *at : kNoMembers;
}

std::string_view GltfDocument::buffer(std::uint64_t index) {
  if (const auto known = buffers_.find(index); known != buffers_.end()) return known->second;
  const std::string_view bytes = load(index);
  const std::uint64_t declared = required_number_in(item("buffers", index), "byteLength");
  if (bytes.size() < declared) {
    throw GltfFault{fmt::format("buffer {} has {} bytes of the {} that it declares", index, bytes.size(), declared)};
  }
  return buffers_.emplace(index, bytes.substr(0, declared)).first->second;
}

std::string_view GltfDocument::load(std::uint64_t index) {
  const Json& buffer = item("buffers", index);
  if (!buffer.contains("uri")) {
    if (index != 0 || binary_.data() == nullptr) throw GltfFault{fmt::format("buffer {} has no bytes", index)};
    return binary_;
  }
  const std::string uri = text_in(buffer, "uri");
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    std::string bytes;
    if (comma == std::string::npos || !uri.substr(0, comma).ends_with(";base64") ||
        !decode_base64(std::string_view(uri).substr(comma + 1), bytes)) {
      throw GltfFault{fmt::format("buffer {} is no base64", index)};
    }
    return others_.insert_or_assign(fmt::format("data:{}", index), std::move(bytes)).first->second;
  }
  const Result<std::string> file = file_of_folder(folder_, folder_ + "/" + uri);
  if (!file) throw GltfFault{"it names the file " + file.error().message};
  if (const auto known = others_.find(file.value()); known != others_.end()) return known->second;
  Result<std::string> bytes = read_mesh_bytes(file.value(), kMostFileBytes - std::min(kMostFileBytes, size_));
  if (!bytes) throw GltfFault{"it names a file that cannot be read: " + bytes.error().message};
  size_ += bytes.value().size();
  return others_.emplace(file.value(), std::move(bytes).value()).first->second;
}

}  // namespace medial_vk
