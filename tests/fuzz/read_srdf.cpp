// The reader of SRDF, on any bytes: pairs of different links of the robot, or a clear message.
#include <algorithm>
#include <tuple>

#include "fuzz/require.h"
#include "robots/model/link_pairs.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace medial_vk;
  Robot robot;
  for (const char* name : {"a", "b", "c"}) robot.links.push_back({name, {}, {}});
  const Result<std::vector<LinkPair>> pairs = read_srdf(fuzz::as_text(data, size), fuzz::kName, robot);
  if (!pairs.ok()) {
    fuzz::require_clear(pairs.error(), ErrorCode::kInvalidMesh);
    fuzz::require(pairs.error().message.starts_with(fuzz::kName + ":"), "a message begins with the name of the file");
    return 0;
  }
  for (const LinkPair& pair : pairs.value()) fuzz::require(pair.a < pair.b && pair.b < 3, "pairs are of two links");
  fuzz::require(std::ranges::adjacent_find(pairs.value(),
                                           [](const LinkPair& p, const LinkPair& q) {
                                             return std::tie(p.a, p.b) >= std::tie(q.a, q.b);
                                           }) == pairs.value().end(),
                "pairs are sorted and differ");
  const ReasonedPairs left_out[] = {{"User", pairs.value()}};
  const Result<std::vector<LinkPair>> again = read_srdf(encode_srdf(robot, left_out), fuzz::kName, robot);
  fuzz::require(again.ok() && again.value() == pairs.value(), "what is written reads back");
  return 0;
}
