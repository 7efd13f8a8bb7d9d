// Shared definitions of the fuzz targets: a property that does not hold ends the process, and the fuzzer keeps the
// input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "medial_vk/mesh.h"
#include "medial_vk/result.h"

namespace medial_vk::fuzz {

/// The name of the input in messages, for every target.
inline const std::string kName = "input";

/// Aborts, naming the property, unless it holds.
void require(bool holds, const char* property);

/// One line of printable characters and readable length, for any input.
void require_clear(const Error& error, ErrorCode code);

/// Requires valid indices, finite coordinates, and no more of either than the bytes can hold; or a clear error that
/// names the input.
void require_mesh_or_message(const Result<Mesh>& mesh, std::string_view bytes);

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace medial_vk::fuzz

/// Called by libFuzzer for every input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
