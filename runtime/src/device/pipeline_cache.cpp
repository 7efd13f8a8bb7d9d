#include "device/pipeline_cache.h"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <new>
#include <system_error>

#include "device/context_impl.h"

namespace medial_vk {
namespace {

namespace fs = std::filesystem;

/// Before the driver's data: drivers check the header of Vulkan, but not all survive damage behind it.
struct FileHeader {
  std::array<char, 8> magic = {'m', 'e', 'd', 'v', 'k', 'p', 'c', '1'};
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
};

/// Far above any real cache of a dozen kernels; the limit prevents a forged file from filling the memory.
constexpr std::uint64_t kMaxCacheBytes = 256ull << 20;

std::uint64_t fnv1a(std::span<const std::byte> data) {
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const std::byte byte : data) {
    hash = (hash ^ std::to_integer<std::uint64_t>(byte)) * 0x100000001b3ull;
  }
  return hash;
}

template <class Bytes>
std::string hex(const Bytes& bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string hex(std::uint32_t value) {
  return hex(std::array{static_cast<std::uint8_t>(value >> 24), static_cast<std::uint8_t>(value >> 16),
                        static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)});
}

bool matches(std::span<const std::byte> data, const PipelineCacheIdentity& identity) {
  VkPipelineCacheHeaderVersionOne header{};
  if (data.size() < sizeof(header)) return false;
  std::memcpy(&header, data.data(), sizeof(header));
  return header.headerSize >= sizeof(header) && header.headerSize <= data.size() &&
         header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && header.vendorID == identity.vendor &&
         header.deviceID == identity.device &&
         std::memcmp(header.pipelineCacheUUID, identity.cache_uuid.data(), VK_UUID_SIZE) == 0;
}

/// Of UTF-8: on Windows the standard library reads `char` in the code page of the system.
fs::path path_of(const std::string& utf8) { return std::u8string(utf8.begin(), utf8.end()); }

std::string text_of(const fs::path& path) {
  const std::u8string text = path.generic_u8string();
  return {text.begin(), text.end()};
}

/// Distinct from that of any other process or context that writes the same cache now.
fs::path temporary_name(const fs::path& file, const void* unique) {
  const auto now = static_cast<std::uint64_t>(std::chrono::high_resolution_clock::now().time_since_epoch().count());
  const auto address = reinterpret_cast<std::uintptr_t>(unique);
  fs::path name = file;
  name += "." + std::to_string(now ^ static_cast<std::uint64_t>(address)) + ".tmp";
  return name;
}

}  // namespace

std::string pipeline_cache_folder(const std::string& option) {
  if (!option.empty()) return option;
#if defined(_WIN32)
  const wchar_t* local = ::_wgetenv(L"LOCALAPPDATA");
  return local != nullptr && local[0] != L'\0' ? text_of(fs::path(local) / "medial-vk") : std::string();
#else
  // By the XDG rules a relative path is ignored.
  const char* cache_home = std::getenv("XDG_CACHE_HOME");
  if (cache_home != nullptr && cache_home[0] == '/') return std::string(cache_home) + "/medial-vk";
  const char* home = std::getenv("HOME");
  if (home != nullptr && home[0] == '/') return std::string(home) + "/.cache/medial-vk";
  return {};
#endif
}

std::string pipeline_cache_file(const std::string& folder, const PipelineCacheIdentity& identity) {
  if (folder.empty()) return {};
  const std::string name =
      "pipelines-" + hex(identity.vendor) + "-" + hex(identity.device) + "-" + hex(identity.driver_uuid) + ".bin";
  return text_of(path_of(folder) / name);
}

std::vector<std::byte> read_pipeline_cache(const std::string& file, const PipelineCacheIdentity& identity) {
  if (file.empty()) return {};
  std::ifstream stream(path_of(file), std::ios::binary);
  FileHeader header;
  if (!stream.read(reinterpret_cast<char*>(&header), sizeof(header))) return {};
  if (header.magic != FileHeader().magic || header.bytes > kMaxCacheBytes) return {};
  std::vector<std::byte> data(static_cast<std::size_t>(header.bytes));
  if (!stream.read(reinterpret_cast<char*>(data.data()), static_cast<std::streamsize>(data.size()))) return {};
  if (fnv1a(data) != header.checksum || !matches(data, identity)) return {};
  return data;
}

bool write_pipeline_cache(const std::string& file, std::span<const std::byte> data) {
  if (file.empty() || data.size() > kMaxCacheBytes) return false;
  std::error_code error;
  fs::create_directories(path_of(file).parent_path(), error);
  if (error) return false;
  const fs::path temporary = temporary_name(path_of(file), data.data());
  FileHeader header;
  header.bytes = data.size();
  header.checksum = fnv1a(data);
  {
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream.write(reinterpret_cast<const char*>(&header), sizeof(header));
    stream.write(reinterpret_cast<const char*>(data.data()), static_cast<std::streamsize>(data.size()));
    stream.close();
    if (stream.good()) fs::rename(temporary, path_of(file), error);
    if (stream.good() && !error) return true;
  }
  fs::remove(temporary, error);
  return false;
}

Status Context::Impl::open_pipeline_cache(const std::string& folder_option) {
  pipeline_cache_file_ = pipeline_cache_file(pipeline_cache_folder(folder_option), pipeline_cache_identity_);
  const std::vector<std::byte> data = read_pipeline_cache(pipeline_cache_file_, pipeline_cache_identity_);
  VkPipelineCacheCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  info.initialDataSize = data.size();
  info.pInitialData = data.data();
  VkResult result = vk.vkCreatePipelineCache(device, &info, allocation_callbacks, &pipeline_cache_);
  if (result != VK_SUCCESS && !data.empty()) {  // the driver may have rejected the data: start with an empty cache
    info.initialDataSize = 0;
    info.pInitialData = nullptr;
    result = vk.vkCreatePipelineCache(device, &info, allocation_callbacks, &pipeline_cache_);
  }
  if (result != VK_SUCCESS) return vulkan_error("vkCreatePipelineCache", result);
  pipeline_cache_checksum_ = fnv1a(data);
  return {};
}

void Context::Impl::save_pipeline_cache() noexcept try {
  if (pipeline_cache_ == VK_NULL_HANDLE) return;
  std::size_t bytes = 0;
  std::vector<std::byte> data;
  // Without a program of its own this context has nothing to add to the file.
  if (!pipeline_cache_file_.empty() && !programs_.empty() &&
      vk.vkGetPipelineCacheData(device, pipeline_cache_, &bytes, nullptr) == VK_SUCCESS) {
    data.resize(bytes);
    const VkResult result = vk.vkGetPipelineCacheData(device, pipeline_cache_, &bytes, data.data());
    data.resize(bytes);
    const bool is_new = result == VK_SUCCESS && !data.empty() && fnv1a(data) != pipeline_cache_checksum_;
    if (is_new && write_pipeline_cache(pipeline_cache_file_, data)) pipeline_cache_checksum_ = fnv1a(data);
  }
} catch (...) {  // out of memory or an invalid path; the file only saves time
}

}  // namespace medial_vk
