// The system and the machine, for `medial-vk doctor`, and the memory of long runs.
#pragma once

#include <string>
#include <vector>

namespace medial_vk::platform {

/// Between folders in the values of environment variables.
#if defined(_WIN32)
inline constexpr char kListSeparator = ';';
inline constexpr bool kIsWindows = true;
#else
inline constexpr char kListSeparator = ':';
inline constexpr bool kIsWindows = false;
#endif

/// "Windows 10.0.19045"; empty where a file of the system has its name.
std::string system_name();
/// "Linux 6.1.0, x86_64".
std::string kernel_name();

/// From now on the system gets blocks of memory of 1 MiB and more back as soon as they are freed. GNU's malloc() keeps
/// them otherwise, up to 32 MiB each, once a block of that size has been freed: a process that works on thousands of
/// meshes then grows by what its free memory is divided into. Elsewhere nothing is done.
void return_large_blocks();

/// True for a program with more rights than its user, for which the Vulkan loader ignores some variables.
bool has_more_rights();

/// The group to which a file belongs; empty: unknown.
std::string group_of(const std::string& file);
/// Why it cannot be opened for reading and writing; empty: it can.
std::string why_not_open(const std::string& file);

/// On Windows, the files of Vulkan drivers that the registry names, and its display adapters: "NVIDIA T400".
std::vector<std::string> registered_drivers();
std::vector<std::string> registered_adapters();

}  // namespace medial_vk::platform
