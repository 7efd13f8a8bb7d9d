// The medial PLY byte by byte, against a parser of its own that shares nothing with the writer, and the reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "medial_vk/version.h"
#include "output/medial_ply/medial_file.h"
#include "support/medial_points.h"

namespace medial_vk {
namespace {

using test::some_header;
using testing::HasSubstr;

std::vector<MedialSphere> two_spheres() {
  MedialSphere a;
  a.centre = {1.0 / 3.0, 0.2, 123456.789012345678};
  a.radius = 0.1;
  a.spoke_a = {0.6f, -0.8f, 0.0f};
  a.spoke_b = {-1.0f, 0.0f, 1e-7f};
  a.object_angle = 1.1f;
  a.flux = -0.25f;
  a.sheet = -1;
  MedialSphere b = a;
  b.centre = {-0.999, 0.11, 0.5};
  b.sheet = 7;
  return {a, b};
}

/// The numbers of one vertex, in the order of the contract.
std::vector<double> numbers_of(const MedialSphere& s) {
  std::vector<double> out = {s.centre[0], s.centre[1], s.centre[2], s.radius};
  for (const float x : s.spoke_a) out.push_back(x);
  for (const float x : s.spoke_b) out.push_back(x);
  out.insert(out.end(), {static_cast<double>(s.object_angle), static_cast<double>(s.flux), 1.0 * s.sheet});
  return out;
}

/// An independent reading of the body: integers from bytes by shifts, then bit casts.
std::vector<double> parse_binary_vertex(const std::string& bytes, std::size_t offset) {
  const auto bits = [&](std::size_t at, int count) {
    std::uint64_t value = 0;
    for (int i = count - 1; i >= 0; --i) {
      value = (value << 8) | static_cast<unsigned char>(bytes.at(at + static_cast<std::size_t>(i)));
    }
    return value;
  };
  std::vector<double> out;
  for (std::size_t i = 0; i < 4; ++i) out.push_back(std::bit_cast<double>(bits(offset + 8 * i, 8)));
  for (std::size_t i = 0; i < 8; ++i) {
    out.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits(offset + 32 + 4 * i, 4))));
  }
  out.push_back(static_cast<std::int32_t>(bits(offset + 64, 4)));
  return out;
}

TEST(OutputMedialFile, HeaderIsExactlyThatOfTheContract) {
  const std::string ply = encode_ply(some_header(), two_spheres(), false);
  EXPECT_EQ(ply.substr(0, ply.find("end_header\n")),
            "ply\nformat binary_little_endian 1.0\n"
            "comment medial-vk 1.2.3\ncomment grid_origin -1 0.1 1e-09\ncomment voxel_size 0.00625\n"
            "comment epsilon 6.25e-05\ncomment object_angle 0.6\ncomment radius_threshold 0.125\n"
            "element vertex 2\n"
            "property double x\nproperty double y\nproperty double z\nproperty double radius\n"
            "property float spoke_a_x\nproperty float spoke_a_y\nproperty float spoke_a_z\n"
            "property float spoke_b_x\nproperty float spoke_b_y\nproperty float spoke_b_z\n"
            "property float object_angle\nproperty float flux\nproperty int sheet\n");
}

TEST(OutputMedialFile, BinaryBodyHoldsTheExactNumbers) {
  const std::string ply = encode_ply(some_header(), two_spheres(), false);
  const std::size_t body = ply.find("end_header\n") + 11;
  ASSERT_EQ(ply.size() - body, 2u * 68u);
  EXPECT_EQ(parse_binary_vertex(ply, body), numbers_of(two_spheres()[0]));
  EXPECT_EQ(parse_binary_vertex(ply, body + 68), numbers_of(two_spheres()[1]));
}

TEST(OutputMedialFile, TextHoldsTheSameNumbersAsBinary) {
  const std::string ply = encode_ply(some_header(), two_spheres(), true);
  EXPECT_THAT(ply, HasSubstr("format ascii 1.0\n"));
  std::istringstream body(ply.substr(ply.find("end_header\n") + 11));
  for (const MedialSphere& sphere : two_spheres()) {
    const std::vector<double> wanted = numbers_of(sphere);
    std::string line;
    ASSERT_TRUE(std::getline(body, line));
    std::istringstream words(line);
    std::string word;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      ASSERT_TRUE(words >> word);
      // Floats are read as floats, as the file declares them.
      const double read = i < 4 ? std::stod(word) : i < 12 ? static_cast<double>(std::stof(word)) : std::stoi(word);
      EXPECT_EQ(read, wanted[i]) << "number " << i;
    }
    EXPECT_FALSE(words >> word);
  }
}

TEST(OutputMedialFile, ReaderGivesBackWhatWasWritten) {
  for (const bool ascii : {false, true}) {
    const Result<MedialFile> file = decode_ply(encode_ply(some_header(), two_spheres(), ascii), "test");
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ(file.value().header.version, "1.2.3");
    EXPECT_EQ(file.value().header.grid_origin, some_header().grid_origin);
    EXPECT_EQ(file.value().header.voxel_size, some_header().voxel_size);
    EXPECT_EQ(file.value().header.epsilon, some_header().epsilon);
    EXPECT_EQ(file.value().header.object_angle, some_header().object_angle);
    EXPECT_EQ(file.value().header.radius_threshold, some_header().radius_threshold);
    ASSERT_EQ(file.value().spheres.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(numbers_of(file.value().spheres[i]), numbers_of(two_spheres()[i]));
    }
    const std::array<std::uint32_t, 3> voxel = file.value().spheres[1].voxel;
    EXPECT_EQ(voxel[0], static_cast<std::uint32_t>(std::floor((-0.999 + 1.0) / 0.00625)));
    EXPECT_EQ(voxel[2], static_cast<std::uint32_t>(std::floor((0.5 - 1e-9) / 0.00625)));
  }
}

TEST(OutputMedialFile, NoPointsIsAFileToo) {
  for (const bool ascii : {false, true}) {
    const Result<MedialFile> file = decode_ply(encode_ply(some_header(), {}, ascii), "test");
    ASSERT_TRUE(file.ok());
    EXPECT_TRUE(file.value().spheres.empty());
  }
}

TEST(OutputMedialFile, ReaderRefusesEveryTruncation) {
  const std::vector<MedialSphere> spheres = two_spheres();
  const std::string binary = encode_ply(some_header(), spheres, false);
  for (std::size_t size = 0; size < binary.size(); ++size) {
    ASSERT_FALSE(decode_ply(std::string_view(binary).substr(0, size), "cut").ok()) << size;
  }
  const std::string text = encode_ply(some_header(), spheres, true);
  const std::size_t last_word = text.find_last_of(' ');
  for (std::size_t size = 0; size <= last_word; ++size) {
    ASSERT_FALSE(decode_ply(std::string_view(text).substr(0, size), "cut").ok()) << size;
  }
}

TEST(OutputMedialFile, ReaderRefusesForeignHeadersAndWildCounts) {
  std::string ply = encode_ply(some_header(), two_spheres(), false);
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string copy = ply;
    copy.replace(copy.find(from), from.size(), to);
    return copy;
  };
  EXPECT_FALSE(decode_ply(replaced("vertex 2", "vertex 99999999999999"), "test").ok());
  EXPECT_FALSE(decode_ply(replaced("vertex 2", "vertex 1"), "test").ok());
  EXPECT_FALSE(decode_ply(replaced("double radius", "float radius"), "test").ok());
  EXPECT_FALSE(decode_ply(replaced("little", "big"), "test").ok());
  EXPECT_FALSE(decode_ply(replaced("property double x\n", "property\n"), "test").ok());
  EXPECT_FALSE(decode_ply("", "test").ok());
}

// Found by the fuzz target read_medial_ply: a file without a version could be read, but not be written and read again.
TEST(OutputMedialFile, ReaderRefusesAHeaderWithoutOneOfItsComments) {
  const std::string ply = encode_ply(some_header(), two_spheres(), true);
  for (const char* comment : {"comment medial-vk", "comment grid_origin", "comment voxel_size", "comment epsilon",
                              "comment object_angle", "comment radius_threshold"}) {
    std::string copy = ply;
    copy.replace(copy.find(comment), std::string_view("comment ").size(), "comment no_");
    const Result<MedialFile> file = decode_ply(copy, "test");
    ASSERT_FALSE(file.ok()) << comment;
    EXPECT_EQ(file.error().message, "test: the header is not that of a medial PLY");
  }
}

TEST(OutputMedialFile, ReaderRefusesWhatFollowsTheLastPoint) {
  for (const bool ascii : {false, true}) {
    const std::string ply = encode_ply(some_header(), two_spheres(), ascii);
    EXPECT_FALSE(decode_ply(ply + "0", "test").ok());
  }
}

// "12" may be the rest of "123".
TEST(OutputMedialFile, ReaderRefusesALastLineWithoutItsEnd) {
  std::vector<MedialSphere> spheres = two_spheres();
  spheres.back().sheet = 123;
  const std::string text = encode_ply(some_header(), spheres, true);
  ASSERT_TRUE(text.ends_with(" 123\n"));
  for (std::size_t cut = 1; cut <= 4; ++cut) {
    EXPECT_FALSE(decode_ply(std::string_view(text).substr(0, text.size() - cut), "test").ok()) << cut;
  }
}

TEST(OutputMedialFile, ReaderRefusesNumbersThatAreNone) {
  std::vector<MedialSphere> spheres = two_spheres();
  MedialHeader header = some_header();
  spheres[1].radius = std::numeric_limits<double>::infinity();
  for (const bool ascii : {false, true}) EXPECT_FALSE(decode_ply(encode_ply(header, spheres, ascii), "test").ok());
  spheres = two_spheres();
  spheres[0].spoke_b[1] = std::numeric_limits<float>::quiet_NaN();
  for (const bool ascii : {false, true}) EXPECT_FALSE(decode_ply(encode_ply(header, spheres, ascii), "test").ok());
  header.voxel_size = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(decode_ply(encode_ply(header, two_spheres(), false), "test").ok());
}

TEST(OutputMedialFile, CsvHasATitleAndALinePerPoint) {
  std::istringstream csv(encode_csv(MedialHeader(), two_spheres()));
  std::string line;
  ASSERT_TRUE(std::getline(csv, line));
  EXPECT_EQ(line, "x,y,z,radius,spoke_a_x,spoke_a_y,spoke_a_z,spoke_b_x,spoke_b_y,spoke_b_z,object_angle,flux,sheet");
  for (const MedialSphere& sphere : two_spheres()) {
    ASSERT_TRUE(std::getline(csv, line));
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 12);
    EXPECT_EQ(std::stod(line), sphere.centre[0]);
  }
  EXPECT_FALSE(std::getline(csv, line));
}

TEST(OutputMedialFile, FormatIsThatOfTheExtension) {
  EXPECT_EQ(medial_format_of("a/b.c/points.PLY").value(), MedialFormat::kPly);
  EXPECT_EQ(medial_format_of("points.csv").value(), MedialFormat::kCsv);
  EXPECT_EQ(medial_format_of("points.npz").value(), MedialFormat::kNpz);
  EXPECT_EQ(medial_format_of("points.Json").value(), MedialFormat::kJson);
  EXPECT_EQ(medial_format_of("points.glb").value(), MedialFormat::kGlb);
  for (const char* path : {"points", "points.obj", "points.gltf", "points.ply/", ".ply"}) {
    const Result<MedialFormat> format = medial_format_of(path);
    ASSERT_FALSE(format.ok()) << path;
    EXPECT_EQ(format.error().code, ErrorCode::kUsage);
  }
}

TEST(OutputMedialFile, HeaderTurnsFractionsIntoLengths) {
  ExtractionOptions options;
  options.radius = 0.25;
  const MedialHeader header = make_header({{1, 2, 3}, 0.5, {4, 4, 4}}, options, 80.0);
  EXPECT_EQ(header.version, version());
  EXPECT_EQ(header.epsilon, 0.005);
  EXPECT_EQ(header.radius_threshold, 20.0);
  EXPECT_EQ(header.object_angle, 0.6);
}

}  // namespace
}  // namespace medial_vk
