// The readers of balls and spokes in the JSON and the arrays that this program writes, on any bytes: balls in range, or
// a clear message. Input that begins with the magic of an array becomes those of a zip, so that what is behind its
// CRC-32 is reached, too; all else that is no zip is JSON.
#include <array>
#include <cmath>
#include <vector>

#include "ball_files/ball_arrays.h"
#include "fuzz/require.h"
#include "output/numpy_files/zip_archive.h"

namespace {

using namespace medial_vk;

constexpr std::string_view kMagic = "\x93NUMPY";

/// Each part that begins with the magic is the next of these arrays.
std::string zip_of_arrays(std::string_view bytes) {
  std::vector<ZipMember> members;
  for (const char* name : {"centre.npy", "radius.npy", "spoke_a.npy", "spoke_b.npy"}) {
    if (!bytes.starts_with(kMagic)) break;
    const std::size_t end = std::min(bytes.find(kMagic, kMagic.size()), bytes.size());
    members.push_back({name, std::string(bytes.substr(0, end))});
    bytes.remove_prefix(end);
  }
  const Result<std::string> zip = make_zip(members);
  fuzz::require(zip.ok(), "a zip is made");
  return zip.value();
}

Result<BallsWithSpokes> read(std::string_view bytes) {
  if (bytes.starts_with("PK")) return balls_of_arrays(bytes, fuzz::kName);
  if (bytes.starts_with(kMagic)) return balls_of_arrays(zip_of_arrays(bytes), fuzz::kName);
  return balls_of_json(bytes, fuzz::kName);
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Result<BallsWithSpokes> balls = read(fuzz::as_text(data, size));
  if (!balls.ok()) {
    const bool is_outside = balls.error().code == ErrorCode::kUsage;  // a ball with this side
    fuzz::require_clear(balls.error(), is_outside ? ErrorCode::kUsage : ErrorCode::kInvalidMesh);
    fuzz::require(balls.error().message.starts_with(fuzz::kName + ":"), "a message begins with the name of the file");
    return 0;
  }
  const BallsWithSpokes& read = balls.value();
  fuzz::require(read.spokes.empty() || read.spokes.size() == read.balls.size(), "all balls have spokes, or none");
  for (const Ball& ball : read.balls) {
    for (const double x : ball.centre) fuzz::require(std::fabs(x) <= 1e18, "centres are in range");
    fuzz::require(ball.radius > 0 && ball.radius <= 1e18, "radii are in range");
  }
  for (const SpokePair& pair : read.spokes) {
    for (const Point& p : {pair.a, pair.b}) {
      fuzz::require(std::fabs(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 1) < 1e-3, "spokes are unit vectors");
    }
  }
  return 0;
}
