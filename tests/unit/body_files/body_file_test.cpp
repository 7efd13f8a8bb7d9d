// Body files: written, read back, cut short and altered.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "body_files/body_file.h"
#include "support/solids/solids.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;

BodyFile some_body() {
  BodyFile file;
  file.version = "1.2.3";
  file.mesh = test::make_box({1, 2, 3});
  file.inside = {{{0.5, 1, 1.5}, 0.5}, {{0.1, 0.1, 0.1}, 0.1}};
  file.cover = {{{0.5, 1, 1.5}, 2}};
  file.measures = {-1e-9, {0.5, 0.75}, {0.25, 0.5}, 12, 8, 6, 0.5, 30};
  return file;
}

TEST(BodyFile, ReadsBackTheSameNumbers) {
  const BodyFile file = some_body();
  const std::string bytes = encode_body_file(file).value();
  EXPECT_EQ(bytes, encode_body_file(file).value());
  const BodyFile back = decode_body_file(bytes, "b.npz").value();
  EXPECT_EQ(back.version, "1.2.3");
  EXPECT_EQ(back.mesh.vertices, file.mesh.vertices);
  EXPECT_EQ(back.mesh.triangles, file.mesh.triangles);
  ASSERT_EQ(back.inside.size(), 2u);
  EXPECT_EQ(back.inside[1].centre, file.inside[1].centre);
  EXPECT_EQ(back.inside[1].radius, 0.1);
  ASSERT_EQ(back.cover.size(), 1u);
  EXPECT_EQ(back.measures.inside_gap.upper, 0.75);
  EXPECT_EQ(back.measures.envelope_vertices, 8u);
}

TEST(BodyFile, CutShortIsAnError) {
  const std::string bytes = encode_body_file(some_body()).value();
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    const Result<BodyFile> file = decode_body_file(std::string_view(bytes).substr(0, size), "b.npz");
    ASSERT_FALSE(file) << size;
    EXPECT_EQ(file.error().code, ErrorCode::kInvalidMesh);
    EXPECT_THAT(file.error().message, testing::StartsWith("b.npz: "));
  }
}

/// The CRC-32 of a member covers every byte of it; other bytes of a zip may change without effect.
TEST(BodyFile, AnAlteredByteIsAnErrorOrChangesNothing) {
  const BodyFile file = some_body();
  const std::string bytes = encode_body_file(file).value();
  std::size_t refused = 0;
  for (std::size_t at = 0; at < bytes.size(); at += 5) {
    std::string altered = bytes;
    altered[at] = static_cast<char>(altered[at] ^ 0x10);
    const Result<BodyFile> back = decode_body_file(altered, "b.npz");
    refused += !back;
    if (!back) continue;
    EXPECT_EQ(back.value().mesh.vertices, file.mesh.vertices) << at;
    EXPECT_EQ(back.value().mesh.triangles, file.mesh.triangles) << at;
    EXPECT_EQ(back.value().inside[0].radius, 0.5) << at;
  }
  EXPECT_GT(refused, bytes.size() / 10);
}

TEST(BodyFile, ValuesThatCannotBeAreNamed) {
  const auto message = [](const BodyFile& file) {
    return decode_body_file(encode_body_file(file).value(), "b.npz").error().message;
  };
  BodyFile file = some_body();
  file.inside[1].radius = -1;
  EXPECT_THAT(message(file), HasSubstr("inside_radius is negative for ball 1"));
  file = some_body();
  file.cover[0].centre[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(message(file), HasSubstr("cover_centre"));
  file = some_body();
  file.mesh.triangles[3][1] = 8;
  EXPECT_THAT(message(file), HasSubstr("triangles use vertex 8 of 8"));
  file = some_body();
  file.mesh.triangles.clear();
  EXPECT_THAT(message(file), HasSubstr("triangles are none"));
  EXPECT_THAT(decode_body_file("PK nothing", "b.npz").error().message, HasSubstr("it is no .npz"));
}

}  // namespace
}  // namespace medial_vk
