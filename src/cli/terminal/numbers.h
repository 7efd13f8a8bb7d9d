// Numbers in readable form.
#pragma once

#include <cstdint>
#include <string>

namespace medial_vk::cli {

std::string grouped(std::uint64_t number);     ///< "1,234,567"
std::string duration(double seconds);          ///< "0.12 s", "12 s", "3 min 05 s", "2 h 10 min"
std::string microseconds(double seconds);      ///< "0.123", "12.3", "12,346"
std::string byte_size(std::uint64_t bytes);    ///< "812 B", "1.2 MB" (powers of 1000)
std::string memory_size(std::uint64_t bytes);  ///< "512 MiB", "1.5 GiB" (powers of 1024)
/// "1 face", "2 faces".
std::string counted(std::uint64_t number, const std::string& one, const std::string& many);

}  // namespace medial_vk::cli
