// The reader of tables of joints, on any bytes: a finite number for each joint, or a clear message.
#include "joint_files/read_joint_values.h"

#include <cmath>

#include "fuzz/require.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  const std::string joints[] = {"a", "b c"};
  const std::string_view text = fuzz::as_text(data, size);
  const Result<std::vector<std::vector<double>>> table = parse_joint_values(text, fuzz::kName, joints);
  if (!table.ok()) {
    fuzz::require_clear(table.error(), ErrorCode::kInvalidMesh);
    fuzz::require(table.error().message.starts_with(fuzz::kName + ":"), "a message begins with the name of the file");
    return 0;
  }
  fuzz::require(!table.value().empty(), "there is a configuration");
  fuzz::require(table.value().size() <= text.size() / 3, "configurations take bytes");
  for (const std::vector<double>& values : table.value()) {
    fuzz::require(values.size() == 2, "each joint has a position");
    for (const double value : values) fuzz::require(std::fabs(value) <= 1e18, "positions are finite");
  }
  return 0;
}
