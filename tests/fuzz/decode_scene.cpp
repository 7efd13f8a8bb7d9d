// The meshes that the process of assimp hands over, the names of their files, and the choice of a format by content, on
// any bytes. What is accepted is encoded again, to the same bytes.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "fuzz/require.h"
#include "scene_files/part_names.h"
#include "scene_files/scene_formats.h"
#include "scene_files/scene_parts.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string_view bytes = fuzz::as_text(data, size);
  const std::string format = scene_format_of(bytes, fuzz::kName);
  fuzz::require(format != "obj" && format != "stl" && format.size() <= 7, "a format is one of assimp's");
  const Result<std::vector<ScenePart>> parts = decode_scene(bytes);
  if (!parts.ok()) {
    const bool is_known = parts.error().code == ErrorCode::kInternal || parts.error().code == ErrorCode::kInvalidMesh ||
                          parts.error().code == ErrorCode::kOutOfMemory;
    fuzz::require(is_known, "an error has the code of its kind");
    return 0;
  }
  for (const ScenePart& part : parts.value()) {
    for (const Point& p : part.mesh.vertices) {
      for (const double x : p) fuzz::require(std::isfinite(x), "coordinates are finite");
    }
    for (const Triangle& t : part.mesh.triangles) {
      for (const std::uint32_t v : t) fuzz::require(v < part.mesh.vertices.size(), "faces use existing vertices");
    }
  }
  std::vector<std::string> names = safe_part_names(parts.value());
  fuzz::require(names.size() == parts.value().size(), "every part has a name");
  for (std::string& name : names) {
    constexpr const char* kSafe = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
    fuzz::require(!name.empty() && name[0] != '-' && name.size() <= 64, "a name is of useful length");
    fuzz::require(name.find_first_not_of(kSafe) == std::string::npos, "a name has safe characters");
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  }
  std::ranges::sort(names);
  fuzz::require(std::ranges::adjacent_find(names) == names.end(), "names differ");
  fuzz::require(encode_scene(parts) == bytes, "what is accepted is encoded to the same bytes");
  return 0;
}
