// A glTF 2.0 document: its JSON, and the bytes of its buffers. Nothing of it is trusted. The reader of glTF in this
// room signals a fault by an exception, which parse_animation() turns into an error.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace medial_vk {

/// The file is not as glTF 2.0 demands, or uses what is not supported.
struct GltfFault {
  std::string what;
};

class GltfDocument {
 public:
  using Json = nlohmann::json;

  /// Of glTF or GLB. Other files are read from the folder of `path`; none if it is empty. Throws GltfFault and
  /// std::bad_alloc, as all members do.
  GltfDocument(std::string bytes, const std::string& path);

  /// How many elements an array of the document has, such as "nodes"; 0 if it is missing.
  std::uint64_t count(const char* list) const;
  /// An element of it, which is an object.
  const Json& item(const char* list, std::uint64_t index) const;
  const Json& root() const { return root_; }
  /// A member of the document; an empty object if it is missing.
  const Json& member(const char* key) const;

  /// The text of the JSON, and the binary chunk of a GLB.
  std::string_view text() const { return text_; }
  std::string_view binary() const { return binary_; }
  /// The bytes of a buffer, at least as many as it declares. They are loaded once.
  std::string_view buffer(std::uint64_t index);
  /// Of the document and of all buffers that were loaded.
  std::uint64_t size() const { return size_; }

 private:
  std::string_view split_glb();
  void check_extensions() const;
  std::string_view load(std::uint64_t index);

  std::string bytes_;
  std::string folder_;
  std::string_view text_;
  std::string_view binary_;  // of a GLB
  Json root_;
  std::map<std::uint64_t, std::string_view> buffers_;  // by index
  std::map<std::string, std::string> others_;          // the bytes of data URIs and files, by URI or path
  std::uint64_t size_ = 0;
};

/// A member that is an index or a count; empty if it is missing.
std::optional<std::uint64_t> whole_number_in(const nlohmann::json& object, const char* key);
/// The same of one that must be there.
std::uint64_t required_number_in(const nlohmann::json& object, const char* key);
/// A text; empty if it is missing or something else.
std::string text_in(const nlohmann::json& object, const char* key);
/// A member that is an array or an object; an empty array if it is missing.
const nlohmann::json& list_in(const nlohmann::json& object, const char* key);
/// A finite number.
double number_of_json(const nlohmann::json& value);
/// An index, an element of an array.
std::uint64_t whole_number_of_json(const nlohmann::json& value);

}  // namespace medial_vk
