// The file that keeps compiled pipelines from one run to the next. It only saves time: every failure to read or write
// it is silent, and a file with altered content is ignored.
#pragma once

#include <volk.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace medial_vk {

/// The key of a cache. The file's name holds vendor, device and driver, so that devices do not share a file; the cache
/// UUID, which changes with the driver's version, must match the file's content.
struct PipelineCacheIdentity {
  std::uint32_t vendor = 0;
  std::uint32_t device = 0;
  std::array<std::uint8_t, VK_UUID_SIZE> driver_uuid{};
  std::array<std::uint8_t, VK_UUID_SIZE> cache_uuid{};
};

/// `option`, else $XDG_CACHE_HOME/medial-vk, else $HOME/.cache/medial-vk, else empty (no cache on disk).
std::string pipeline_cache_folder(const std::string& option);

/// Full path of the cache file; empty if `folder` is.
std::string pipeline_cache_file(const std::string& folder, const PipelineCacheIdentity& identity);

/// The data for VkPipelineCacheCreateInfo, or no data if the file is absent, damaged or of another driver.
std::vector<std::byte> read_pipeline_cache(const std::string& file, const PipelineCacheIdentity& identity);

/// Writes a temporary file beside `file` and renames it, so that readers see the whole old file or the whole new file.
/// Creates the folder if necessary. Returns whether it succeeded.
bool write_pipeline_cache(const std::string& file, std::span<const std::byte> data);

}  // namespace medial_vk
