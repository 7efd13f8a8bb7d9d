// The files that assimp may open for a scene: the scene itself, from memory, and files of its folder.
#pragma once

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace medial_vk {

/// Opens nothing outside of the folder of the scene, whatever a path or a symbolic link says, nothing that is no
/// regular file, and nothing to be written. All files together have a limit.
class SceneIo : public Assimp::IOSystem {
 public:
  /// `main_path` is the name by which assimp requests `bytes`. With `has_folder` false no other file exists.
  SceneIo(std::string main_path, std::string_view bytes, bool has_folder);
  ~SceneIo() override;

  bool Exists(const char* file) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;
  bool ComparePaths(const char* one, const char* second) const override;

  /// Why a file that belongs to the scene was not opened, the first such file; empty: none was missing.
  const std::string& refusal() const { return refusal_; }

 private:
  bool resolve(const std::string& file, std::string& resolved) const;
  void refuse(const std::string& why) const;

  std::string main_path_;
  std::string_view bytes_;
  std::string folder_;  // without symbolic links; empty: none
  std::uint64_t bytes_left_;
  std::map<std::string, std::string> others_;  // by resolved path; kept, since assimp opens some files several times
  mutable std::string refusal_;
};

}  // namespace medial_vk
