#include "program_list.h"

#include <cstddef>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>

#include "embedded_shaders.h"
#include "pipeline_cache.h"

namespace medial_vk {
namespace {

constexpr std::size_t kMostKeys = 256;
constexpr std::size_t kMostConstants = 32;
constexpr const char* kFormat = "medial-vk-programs-1";

/// FNV-1a, by words.
template <class Words>
std::uint64_t add_hash(std::uint64_t hash, const Words& words) {
  for (const auto word : words) hash = (hash ^ static_cast<std::uint64_t>(word)) * 0x100000001b3ull;
  return hash;
}

constexpr std::uint64_t kHashStart = 0xcbf29ce484222325ull;

/// Keys tell how a shader is bound; they are good for the very shaders they were made for.
std::uint64_t hash_of_shaders() {
  std::uint64_t hash = kHashStart;
  for (const EmbeddedShader& shader : embedded_shaders()) {
    hash = add_hash(add_hash(hash, std::string(shader.name)), shader.words);
  }
  return hash;
}

std::string header_of(const std::string& lines) {
  std::ostringstream out;
  out << kFormat << ' ' << hash_of_shaders() << ' ' << add_hash(kHashStart, lines) << '\n';
  return out.str();
}

std::string line_of(const ProgramKey& key) {
  std::ostringstream out;
  out << key.shader << ' ' << key.storage_buffers << ' ' << key.texel_buffers << ' ' << key.push_constant_bytes << ' '
      << key.workgroup_size;
  for (const std::uint32_t constant : key.constants) out << ' ' << constant;
  out << '\n';
  return out.str();
}

ProgramKey key_of(const std::string& line) {
  std::istringstream in(line);
  ProgramKey key;
  in >> key.shader >> key.storage_buffers >> key.texel_buffers >> key.push_constant_bytes >> key.workgroup_size;
  for (std::uint32_t constant = 0; key.constants.size() < kMostConstants && in >> constant;) {
    key.constants.push_back(constant);
  }
  return key;
}

}  // namespace

std::string program_list_file(const std::string& pipeline_cache_file) {
  return pipeline_cache_file.empty() ? std::string() : pipeline_cache_file + ".programs";
}

std::vector<ProgramKey> read_program_list(const std::string& file) {
  if (file.empty()) return {};
  std::ifstream stream(file, std::ios::binary);
  std::string header;
  if (!std::getline(stream, header)) return {};
  const std::string lines((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (header + '\n' != header_of(lines)) return {};
  std::vector<ProgramKey> keys;
  std::istringstream in(lines);
  for (std::string line; keys.size() < kMostKeys && std::getline(in, line);) keys.push_back(key_of(line));
  return keys;
}

void write_program_list(const std::string& file, const std::vector<ProgramKey>& keys) {
  if (file.empty() || keys.size() > kMostKeys) return;
  std::string lines;
  for (const ProgramKey& key : keys) {
    if (key.constants.size() > kMostConstants) return;
    lines += line_of(key);
  }
  const std::string text = header_of(lines) + lines;
  replace_file(file, std::as_bytes(std::span(text)));
}

}  // namespace medial_vk
