#include "scene_files/read_mesh_file.h"

#include <fmt/format.h>

#include <new>

#include "input/read_mesh.h"
#include "scene_files/scene_formats.h"
#include "scene_files/scene_process.h"

namespace medial_vk {
namespace {

Result<std::vector<ScenePart>> read_parts(const std::string& path, const std::string& name) {
  Result<std::string> bytes = read_mesh_bytes(path);
  if (!bytes) return bytes.error();
  const std::string format = scene_format_of(bytes.value(), name);
  if (!format.empty()) {
    return read_scene_apart({std::move(bytes).value(), name, format, path == "-" ? std::string() : path});
  }
  Result<Mesh> mesh = parse_mesh(bytes.value(), name);
  if (!mesh) return mesh.error();
  std::vector<ScenePart> parts(1);
  parts.front().mesh = std::move(mesh).value();
  return parts;
}

Error no_memory(const std::string& name) {
  return {ErrorCode::kOutOfMemory, fmt::format("{}: not enough memory to read it", name)};
}

}  // namespace

Result<std::vector<ScenePart>> read_mesh_parts(const std::string& path) {
  const std::string name = name_of_input(path);
  try {
    return read_parts(path, name);
  } catch (const std::bad_alloc&) {
    return no_memory(name);
  }
}

Result<Mesh> read_mesh_file(const std::string& path) {
  const std::string name = name_of_input(path);
  try {
    Result<std::vector<ScenePart>> parts = read_parts(path, name);
    if (!parts) return parts.error();
    return join_parts(std::move(parts).value(), name);
  } catch (const std::bad_alloc&) {
    return no_memory(name);
  }
}

}  // namespace medial_vk
