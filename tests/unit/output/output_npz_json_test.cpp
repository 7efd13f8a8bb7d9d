// NPZ and JSON: every number, bit by bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "output/medial_formats/encode_json.h"
#include "output/medial_formats/encode_npz.h"
#include "support/medial_points.h"

namespace medial_vk {
namespace {

using test::some_header;
using test::some_spheres;
using testing::HasSubstr;

/// The marks of some_spheres(), which are three.
const std::uint8_t kMarks[] = {kSeam, 0, kSeam | kRim};

template <class T>
T number(const std::string& bytes, std::size_t at) {
  std::uint64_t bits = 0;
  for (std::size_t i = sizeof(T); i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(bytes.at(at + i));
  T value;
  std::memcpy(&value, &bits, sizeof(T));  // the tests run on machines of this byte order only
  return value;
}

struct Array {
  std::string header;
  std::string numbers;
};

/// Walks the local headers of a zip (APPNOTE 4.3.7) of stored members, and the .npy files in it.
std::map<std::string, Array> arrays_of(const std::string& npz) {
  std::map<std::string, Array> out;
  std::size_t at = 0;
  while (number<std::uint32_t>(npz, at) == 0x04034b50) {
    EXPECT_EQ(number<std::uint16_t>(npz, at + 8), 0) << "stored";
    EXPECT_EQ(number<std::uint16_t>(npz, at + 12), 1 << 5 | 1) << "date";
    const std::size_t size = number<std::uint32_t>(npz, at + 18);
    const std::size_t name_size = number<std::uint16_t>(npz, at + 26);
    const std::string name = npz.substr(at + 30, name_size);
    at += 30 + name_size + number<std::uint16_t>(npz, at + 28);
    const std::string npy = npz.substr(at, size);
    EXPECT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t begin = 10 + number<std::uint16_t>(npy, 8);
    EXPECT_EQ(begin % 64, 0u);
    out[name] = {npy.substr(10, begin - 10), npy.substr(begin)};
    at += size;
  }
  return out;
}

TEST(OutputNpz, HoldsEveryNumber) {
  const std::vector<MedialSphere> spheres = some_spheres();
  const auto arrays = arrays_of(encode_npz(some_header(), spheres, kMarks).value());
  ASSERT_EQ(arrays.size(), 16u);
  EXPECT_THAT(arrays.at("centre.npy").header, HasSubstr("{'descr': '<f8', 'fortran_order': False, 'shape': (3, 3), }"));
  EXPECT_THAT(arrays.at("radius.npy").header, HasSubstr("'<f8', 'fortran_order': False, 'shape': (3,), }"));
  EXPECT_THAT(arrays.at("voxel.npy").header, HasSubstr("'<u4', 'fortran_order': False, 'shape': (3, 3), }"));
  EXPECT_THAT(arrays.at("version.npy").header, HasSubstr("'<U5', 'fortran_order': False, 'shape': (), }"));
  EXPECT_THAT(arrays.at("seam.npy").header, HasSubstr("'|b1', 'fortran_order': False, 'shape': (3,), }"));
  EXPECT_EQ(arrays.at("seam.npy").numbers, std::string("\1\0\1", 3));
  EXPECT_EQ(arrays.at("rim.npy").numbers, std::string("\0\0\1", 3));
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    EXPECT_EQ(number<double>(arrays.at("radius.npy").numbers, 8 * i), spheres[i].radius);
    EXPECT_EQ(number<float>(arrays.at("object_angle.npy").numbers, 4 * i), spheres[i].object_angle);
    EXPECT_EQ(number<float>(arrays.at("flux.npy").numbers, 4 * i), spheres[i].flux);
    EXPECT_EQ(number<std::int32_t>(arrays.at("sheet.npy").numbers, 4 * i), spheres[i].sheet);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(number<double>(arrays.at("centre.npy").numbers, 24 * i + 8 * j), spheres[i].centre[j]);
      EXPECT_EQ(number<float>(arrays.at("spoke_a.npy").numbers, 12 * i + 4 * j), spheres[i].spoke_a[j]);
      EXPECT_EQ(number<float>(arrays.at("spoke_b.npy").numbers, 12 * i + 4 * j), spheres[i].spoke_b[j]);
      EXPECT_EQ(number<std::uint32_t>(arrays.at("voxel.npy").numbers, 12 * i + 4 * j), spheres[i].voxel[j]);
    }
  }
  EXPECT_EQ(number<double>(arrays.at("voxel_size.npy").numbers, 0), 0.00625);
  EXPECT_EQ(number<double>(arrays.at("grid_origin.npy").numbers, 8), 0.1);
  EXPECT_EQ(number<double>(arrays.at("object_angle_threshold.npy").numbers, 0), 0.6);
}

TEST(OutputNpz, SamePointsSameBytes) {
  EXPECT_TRUE(encode_npz(some_header(), some_spheres(), kMarks).value() ==
              encode_npz(some_header(), some_spheres(), kMarks).value());
}

TEST(OutputNpz, NoPointsAreEmptyArrays) {
  const auto arrays = arrays_of(encode_npz(some_header(), {}, {}).value());
  EXPECT_THAT(arrays.at("centre.npy").header, HasSubstr("'shape': (0, 3), }"));
  EXPECT_EQ(arrays.at("centre.npy").numbers, "");
}

TEST(OutputJson, HoldsEveryNumber) {
  const std::vector<MedialSphere> spheres = some_spheres();
  const nlohmann::json written = nlohmann::json::parse(encode_json(some_header(), spheres, kMarks));
  EXPECT_EQ(written["format"], 1);
  EXPECT_EQ(written["version"], "1.2.3");
  EXPECT_EQ(written["grid_origin"].get<Point>(), some_header().grid_origin);
  EXPECT_EQ(written["voxel_size"], 0.00625);
  EXPECT_EQ(written["object_angle_threshold"], 0.6);
  ASSERT_EQ(written["points"].size(), spheres.size());
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const nlohmann::json& point = written["points"][i];
    EXPECT_EQ(point["centre"].get<Point>(), spheres[i].centre);
    EXPECT_EQ(point["radius"].get<double>(), spheres[i].radius);
    EXPECT_EQ((point["spoke_a"].get<std::array<float, 3>>()), spheres[i].spoke_a);
    EXPECT_EQ((point["spoke_b"].get<std::array<float, 3>>()), spheres[i].spoke_b);
    EXPECT_EQ(point["object_angle"].get<float>(), spheres[i].object_angle);
    EXPECT_EQ(point["flux"].get<float>(), spheres[i].flux);
    EXPECT_EQ(point["sheet"], spheres[i].sheet);
    EXPECT_EQ(point["seam"], i != 1);
    EXPECT_EQ(point["rim"], i == 2);
    EXPECT_EQ((point["voxel"].get<std::array<std::uint32_t, 3>>()), spheres[i].voxel);
  }
}

TEST(OutputJson, NumbersAreAsShortAsCanBe) {
  EXPECT_THAT(encode_json(some_header(), some_spheres(), kMarks), HasSubstr("\"spoke_a\":[0.6,-0.8,0]"));
}

TEST(OutputJson, NoPointsAreAnEmptyArray) {
  EXPECT_TRUE(nlohmann::json::parse(encode_json(some_header(), {}, {}))["points"].empty());
}

}  // namespace
}  // namespace medial_vk
