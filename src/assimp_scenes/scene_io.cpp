#if defined(MEDIAL_VK_HAS_ASSIMP)  // else nothing of assimp may be needed to build
#include "assimp_scenes/scene_io.h"

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "assimp_scenes/limits.h"
#include "base/quoted.h"
#include "input/read_mesh.h"
#include "platform/paths.h"
#include "scene_files/files_of_folder.h"

namespace medial_vk {
namespace {

/// Reads from bytes that outlive it.
class MemoryStream : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::string_view bytes) : bytes_(bytes) {}

  std::size_t Read(void* target, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0) std::memcpy(target, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t start = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    const std::size_t to = start + offset;  // a negative offset arrives as a number that wraps around
    if (to > bytes_.size()) return aiReturn_FAILURE;
    at_ = to;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

}  // namespace

SceneIo::SceneIo(std::string main_path, std::string_view bytes, bool has_folder)
    : main_path_(std::move(main_path)), bytes_(bytes), bytes_left_(kMostFileBytes - bytes.size()) {
  if (has_folder) folder_ = folder_of_scene(main_path_);
}

SceneIo::~SceneIo() = default;

/// Finds the file, and tests that it may be opened.
bool SceneIo::resolve(const std::string& file, std::string& resolved) const {
  Result<std::string> found = file_of_folder(folder_, file);
  if (!found) {
    refuse(found.error().message);
    return false;
  }
  resolved = std::move(found).value();
  return true;
}

void SceneIo::refuse(const std::string& why) const {
  if (refusal_.empty()) refusal_ = "it names the file " + why;
}

bool SceneIo::Exists(const char* file) const {
  std::string resolved;
  return file == main_path_ || resolve(file, resolved);
}

Assimp::IOStream* SceneIo::Open(const char* file, const char* mode) {
  if (std::strpbrk(mode, "wa+") != nullptr) return nullptr;
  if (file == main_path_) return new MemoryStream(bytes_);
  std::string resolved;
  if (!resolve(file, resolved)) return nullptr;
  const auto known = others_.find(resolved);
  if (known != others_.end()) return new MemoryStream(known->second);
  Result<std::string> bytes = read_mesh_bytes(resolved, bytes_left_);
  if (!bytes) {
    refuse(medial_vk::quoted(platform::file_name_of(file)) + ", which cannot be read or is too long");
    return nullptr;
  }
  bytes_left_ -= bytes.value().size();
  allow_for(bytes.value().size());
  return new MemoryStream(others_.emplace(resolved, std::move(bytes).value()).first->second);
}

void SceneIo::Close(Assimp::IOStream* stream) { delete stream; }

bool SceneIo::ComparePaths(const char* one, const char* second) const { return std::strcmp(one, second) == 0; }

}  // namespace medial_vk
#endif
