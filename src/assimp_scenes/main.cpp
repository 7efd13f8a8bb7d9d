// medial-vk-read-scene: the program in which assimp runs. medial-vk starts it with the bytes of a scene as its standard
// input and reads the meshes from its standard output (scene_files/scene_parts.h).
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

#include "assimp_scenes/limits.h"
#include "assimp_scenes/read_scene.h"

namespace {

/// Standard input as it lies in memory; empty if it is no file.
std::string_view map_input() {
  struct stat status = {};
  if (::fstat(STDIN_FILENO, &status) != 0 || status.st_size <= 0) return {};
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, STDIN_FILENO, 0);
  if (at == MAP_FAILED) return {};
  return {static_cast<const char*>(at), size};
}

bool write_output(const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t written = ::write(STDOUT_FILENO, bytes.data() + at, bytes.size() - at);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    at += static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::fputs("medial-vk-read-scene is started by medial-vk\n", stderr);
    return 2;
  }
  const std::string_view bytes = map_input();
  medial_vk::limit_this_process(bytes.size());
  const std::string scene = medial_vk::encode_scene(
      medial_vk::read_scene({.bytes = bytes, .name = arguments[1], .format = arguments[2], .path = arguments[3]}));
  if (!write_output(scene)) return 1;
  std::fflush(nullptr);
  ::_exit(0);  // the scene is written: a fault in destructors would make no difference
}
