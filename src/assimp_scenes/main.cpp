// medial-vk-read-scene: the program in which assimp runs. medial-vk starts it with the bytes of a scene as its standard
// input and reads the meshes from its standard output (scene_files/scene_parts.h).
#include <cstdio>
#include <string>
#include <vector>

#include "assimp_scenes/limits.h"
#include "assimp_scenes/read_scene.h"
#include "platform/files.h"
#include "platform/processes.h"

int main(int count, char** arguments) {
  namespace platform = medial_vk::platform;
  const std::vector<std::string> words = platform::prepare_process(count, arguments);
  if (words.size() != 3) {
    std::fputs("medial-vk-read-scene is started by medial-vk\n", stderr);
    return 2;
  }
  const std::string_view bytes = platform::standard_input_bytes();
  medial_vk::limit_this_process(bytes.size());
  const std::string scene = medial_vk::encode_scene(
      medial_vk::read_scene({.bytes = bytes, .name = words[0], .format = words[1], .path = words[2]}));
  if (!platform::write_all(platform::kStandardOutput, scene)) return 1;
  std::fflush(nullptr);
  platform::end_process(0);  // the scene is written: a fault in destructors would make no difference
}
