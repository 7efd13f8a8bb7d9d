#if defined(MEDIAL_VK_HAS_ASSIMP)  // else nothing of assimp may be needed to build
#include "assimp_scenes/scene_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "assimp_scenes/limits.h"
#include "base/quoted.h"
#include "input/read_mesh.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;

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

/// "a b.bin" of "a%20b.bin": the file names of glTF and COLLADA are URIs.
std::string without_percent_signs(const std::string& uri) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
  };
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code = uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    name += is_code ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (is_code) i += 2;
  }
  return name;
}

bool is_inside(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

}  // namespace

SceneIo::SceneIo(std::string main_path, std::string_view bytes, bool has_folder)
    : main_path_(std::move(main_path)), bytes_(bytes), bytes_left_(kMostFileBytes - bytes.size()) {
  std::error_code error;
  const fs::path folder = fs::path(main_path_).parent_path();
  if (has_folder) folder_ = fs::canonical(folder.empty() ? "." : folder, error).string();
}

SceneIo::~SceneIo() = default;

void SceneIo::refuse(const std::string& file, const char* why) const {
  if (refusal_.empty())
    refusal_ = fmt::format("it names the file {}, {}", medial_vk::quoted(fs::path(file).filename().string()), why);
}

/// Finds the file, and tests that it may be opened.
bool SceneIo::resolve(const std::string& file, std::string& resolved) const {
  if (folder_.empty()) {
    refuse(file, "but has no folder");
    return false;
  }
  for (const std::string& name : {file, without_percent_signs(file)}) {
    std::error_code error;
    const fs::path path = fs::canonical(name, error);
    if (error) continue;
    if (!is_inside(path, folder_)) {
      refuse(file, "which is outside of its folder");
      return false;
    }
    if (!fs::is_regular_file(path, error)) continue;
    resolved = path.string();
    return true;
  }
  refuse(file, "which is not there");
  return false;
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
    refuse(file, "which cannot be read or is too long");
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
