#include "scene_files/scene_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "input/text_scanner.h"

namespace medial_vk {
namespace {

constexpr std::string_view kStart = "medial-vk scene 1\n";
constexpr std::uint64_t kIsError = ~std::uint64_t{0};  // in the place of the number of parts
constexpr std::uint64_t kMostVertices = 0xfffffffe;

void put(std::uint64_t value, std::string& bytes) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }

void put(const std::string& text, std::string& bytes) {
  put(text.size(), bytes);
  bytes += text;
}

template <class T>
void put_all(const std::vector<T>& values, std::string& bytes) {
  put(values.size(), bytes);
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// Takes values from the front of bytes that may end anywhere.
class Source {
 public:
  explicit Source(std::string_view bytes) : bytes_(bytes) {}

  bool take(std::uint64_t& value) {
    if (bytes_.size() < sizeof value) return false;
    std::memcpy(&value, bytes_.data(), sizeof value);
    bytes_.remove_prefix(sizeof value);
    return true;
  }

  bool take(std::string& text) {
    std::uint64_t size = 0;
    if (!take(size) || size > bytes_.size()) return false;
    text.assign(bytes_.substr(0, size));
    bytes_.remove_prefix(size);
    return true;
  }

  template <class T>
  bool take_all(std::vector<T>& values) {
    std::uint64_t size = 0;
    if (!take(size) || size > bytes_.size() / sizeof(T)) return false;
    values.resize(size);
    if (size > 0) std::memcpy(values.data(), bytes_.data(), size * sizeof(T));
    bytes_.remove_prefix(size * sizeof(T));
    return true;
  }

  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

bool is_valid(const Mesh& mesh) {
  const auto is_finite = [](double x) { return std::isfinite(x); };
  const auto is_vertex = [&](std::uint32_t v) { return v < mesh.vertices.size(); };
  return mesh.vertices.size() <= kMostVertices &&
         std::ranges::all_of(mesh.vertices, [&](const Point& p) { return std::ranges::all_of(p, is_finite); }) &&
         std::ranges::all_of(mesh.triangles, [&](const Triangle& t) { return std::ranges::all_of(t, is_vertex); });
}

Error no_scene() { return {ErrorCode::kInternal, "the program that reads scenes wrote something else"}; }

Result<std::vector<ScenePart>> take_error(Source& source) {
  std::uint64_t code = 0;
  Error error;
  if (!source.take(code) || !source.take(error.message) || !source.at_end()) return no_scene();
  constexpr ErrorCode kPossible[] = {ErrorCode::kInvalidMesh, ErrorCode::kOutOfMemory};
  error.code = static_cast<ErrorCode>(code);
  if (std::ranges::find(kPossible, error.code) == std::end(kPossible)) return no_scene();
  return error;
}

}  // namespace

std::string encode_scene(const Result<std::vector<ScenePart>>& scene) {
  std::string bytes(kStart);
  if (!scene) {
    put(kIsError, bytes);
    put(static_cast<std::uint64_t>(scene.error().code), bytes);
    put(scene.error().message, bytes);
    return bytes;
  }
  put(scene.value().size(), bytes);
  for (const ScenePart& part : scene.value()) {
    put(part.name, bytes);
    put(part.mesh.short_polygons, bytes);
    put(part.mesh.fallback_polygons, bytes);
    put_all(part.mesh.vertices, bytes);
    put_all(part.mesh.triangles, bytes);
  }
  return bytes;
}

Result<std::vector<ScenePart>> decode_scene(std::string_view bytes) {
  if (!bytes.starts_with(kStart)) return no_scene();
  Source source(bytes.substr(kStart.size()));
  std::uint64_t count = 0;
  if (!source.take(count)) return no_scene();
  if (count == kIsError) return take_error(source);
  std::vector<ScenePart> parts;
  for (std::uint64_t i = 0; i < count; ++i) {  // each takes bytes, so a false count ends the loop early
    ScenePart part;
    Mesh& mesh = part.mesh;
    if (!source.take(part.name) || !source.take(mesh.short_polygons) || !source.take(mesh.fallback_polygons) ||
        !source.take_all(mesh.vertices) || !source.take_all(mesh.triangles) || !is_valid(mesh)) {
      return no_scene();
    }
    parts.push_back(std::move(part));
  }
  if (!source.at_end()) return no_scene();
  return parts;
}

Result<Mesh> join_parts(std::vector<ScenePart> parts, const std::string& name) {
  if (parts.size() == 1) return std::move(parts.front().mesh);
  std::uint64_t vertices = 0, triangles = 0;
  for (const ScenePart& part : parts) {
    vertices += part.mesh.vertices.size();
    triangles += part.mesh.triangles.size();
  }
  if (vertices > kMostVertices) return file_error(name, fmt::format("{} vertices are too many", vertices));
  Mesh mesh;
  mesh.vertices.reserve(vertices);
  mesh.triangles.reserve(triangles);
  for (const ScenePart& part : parts) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.mesh.vertices.begin(), part.mesh.vertices.end());
    for (const Triangle& t : part.mesh.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
    mesh.short_polygons += part.mesh.short_polygons;
    mesh.fallback_polygons += part.mesh.fallback_polygons;
  }
  return mesh;
}

}  // namespace medial_vk
