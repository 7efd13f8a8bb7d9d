// Both STL readers, on any bytes: the choice between them depends on bytes that may be wrong.
#include "fuzz/require.h"
#include "input/readers.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string_view bytes = fuzz::as_text(data, size);
  const Result<Mesh> binary = read_binary_stl(bytes, fuzz::kName);
  fuzz::require_mesh_or_message(binary, bytes);
  fuzz::require(
      binary.ok() || !has_size_of_binary_stl(bytes) || binary.error().message.find("coordinate") != std::string::npos,
      "a binary STL of the right size is read unless a coordinate is not finite");
  fuzz::require_mesh_or_message(read_ascii_stl(bytes, fuzz::kName), bytes);
  return 0;
}
