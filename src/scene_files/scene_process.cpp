#include "scene_files/scene_process.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "input/text_scanner.h"
#include "platform/paths.h"
#include "platform/processes.h"

namespace medial_vk {
namespace {

#if !defined(MEDIAL_VK_HELPERS_FROM_BIN)
#define MEDIAL_VK_HELPERS_FROM_BIN "../libexec/medial-vk"
#endif
constexpr const char* kProgram = "medial-vk-read-scene";

/// Beside this program in a build, and in the folder of helpers after installation. Empty: in neither.
std::string find_program() {
  const std::string folder = platform::folder_of_program();
  if (folder.empty()) return {};
  for (const char* below : {"", MEDIAL_VK_HELPERS_FROM_BIN}) {
    std::string path = platform::text_of(platform::path_of(folder) / below / kProgram);
    if (platform::is_program(path)) return path;
  }
  return {};
}

Error system_error(const std::string& name, const char* what, int code) {
  const bool is_memory = code == ENOMEM || code == ENOSPC;
  const std::string message = fmt::format("{}: cannot {}: {}", name, what, std::strerror(code));
  return {is_memory ? ErrorCode::kOutOfMemory : ErrorCode::kInvalidMesh, message};
}

}  // namespace

Result<std::vector<ScenePart>> read_scene_apart(SceneFile file) {
  const std::string program = find_program();
  if (program.empty()) {
    return file_error(file.name, fmt::format("the program {} is missing, in which assimp reads .{} files; it is "
                                             "installed with medial-vk",
                                             kProgram, file.format));
  }
  const platform::ProgramOutcome outcome =
      platform::run_program(program, {file.name, file.format, file.path}, std::move(file.bytes));
  if (outcome.code != 0) {
    const char* const step = outcome.has_input ? "start the program that reads it" : "hand it to assimp";
    return system_error(file.name, step, outcome.code);
  }
  if (!outcome.reason.empty()) {
    return file_error(file.name, fmt::format("assimp failed on this .{} file: {}", file.format, outcome.reason));
  }
  Result<std::vector<ScenePart>> parts = decode_scene(outcome.output);
  if (!parts && parts.error().code == ErrorCode::kInternal) {
    return Error{ErrorCode::kInternal, fmt::format("{}: {}", file.name, parts.error().message)};
  }
  return parts;
}

}  // namespace medial_vk
