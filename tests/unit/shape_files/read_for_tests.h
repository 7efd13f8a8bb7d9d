// Shapes of texts, for the tests of this folder.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shape_files/read_shape_file.h"

namespace medial_vk::shape_tests {

inline ShapeFile shape_of(const std::string& text, const std::string& name, const ShapeFileOptions& options = {}) {
  Result<ShapeFile> shape = parse_shape_file(text, name, options);
  EXPECT_TRUE(shape.ok()) << shape.error().message << "\n" << text;
  return shape.ok() ? std::move(shape).value() : ShapeFile();
}

inline std::string fault_of(const std::string& text, const std::string& name, const ShapeFileOptions& options = {}) {
  const Result<ShapeFile> shape = parse_shape_file(text, name, options);
  EXPECT_FALSE(shape.ok()) << text;
  if (shape.ok()) return {};
  EXPECT_EQ(shape.error().code, ErrorCode::kInvalidMesh) << text;
  return shape.error().message;
}

inline double area_of(const ShapeFile& shape) {
  const Result<PreparedShape> prepared = prepare_shape(shape.rings, shape.fill_rule);
  EXPECT_TRUE(prepared.ok());
  return prepared.ok() ? prepared.value().report.area : 0;
}

/// With the elements between <svg> and </svg>.
inline std::string svg_of(const std::string& elements, const std::string& attributes = "") {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + attributes + ">" + elements + "</svg>";
}

inline ShapeFile shape_of_svg(const std::string& elements, const std::string& attributes = "") {
  return shape_of(svg_of(elements, attributes), "s.svg");
}

inline std::string fault_of_svg(const std::string& elements, const std::string& attributes = "") {
  return fault_of(svg_of(elements, attributes), "s.svg");
}

/// `text` within so many brackets of one kind.
inline std::string nested(std::size_t depth, const std::string& open, const std::string& text,
                          const std::string& close) {
  std::string result;
  for (std::size_t i = 0; i < depth; ++i) result += open;
  result += text;
  for (std::size_t i = 0; i < depth; ++i) result += close;
  return result;
}

/// The only ring.
inline PlaneRing ring_of_svg(const std::string& elements, const std::string& attributes = "") {
  const ShapeFile shape = shape_of_svg(elements, attributes);
  EXPECT_EQ(shape.rings.size(), 1u);
  return shape.rings.empty() ? PlaneRing() : shape.rings.front();
}

/// That of a path.
inline PlaneRing ring_of_path(const std::string& data) { return ring_of_svg("<path d='" + data + "'/>"); }

inline void expect_ring(const PlaneRing& ring, const PlaneRing& expected, double tolerance = 1e-12) {
  ASSERT_EQ(ring.size(), expected.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(ring[i][k], expected[i][k], tolerance) << "point " << i;
  }
}

}  // namespace medial_vk::shape_tests
