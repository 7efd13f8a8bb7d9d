// Binary OFF as Geomview writes it: after the line of the keyword all numbers have four bytes, the most significant
// first. Counts and indices are integers; coordinates, normals, colours and texture coordinates are floats. A face ends
// with the number of the components of its colour, and these.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>

#include "input/polygon_soup.h"
#include "input/readers.h"
#include "input/text_scanner.h"

namespace medial_vk {
namespace {

constexpr std::uint64_t kWord = 4;  // bytes

class BinaryOffReader {
 public:
  BinaryOffReader(std::string_view bytes, std::uint64_t floats, const std::string& name)
      : bytes_(bytes), floats_(floats), name_(name) {}

  Status read_dimension() {
    if (words_left() == 0) return error("file ends before its dimension");
    const std::uint32_t dimension = next();
    return dimension == 3 ? Status{} : error(fmt::format("{} dimensions: only three can be read", dimension));
  }

  Result<Mesh> read() {
    if (const Status status = read_counts(); !status) return status.error();
    if (const Status status = read_vertices(); !status) return status.error();
    for (std::uint64_t i = 0; i < faces_; ++i) {
      if (const Status status = read_face(i); !status) return status.error();
    }
    return triangulate(std::move(soup_));
  }

 private:
  Error error(std::string_view what) const { return file_error(name_, what); }

  std::uint64_t words_left() const { return (bytes_.size() - at_) / kWord; }

  /// Precondition: words_left() > 0.
  std::uint32_t next() {
    std::uint32_t word = 0;
    for (std::uint64_t i = 0; i < kWord; ++i) word = word << 8 | static_cast<unsigned char>(bytes_[at_ + i]);
    at_ += kWord;
    return word;
  }

  Status read_counts() {
    if (words_left() < 3) return error("file ends before the counts of vertices and faces");
    vertices_ = next();
    faces_ = next();
    next();  // the count of edges, which is not needed
    // A face has at least its two numbers. Tested before memory is allocated.
    const std::uint64_t left = words_left();
    if (vertices_ > left / floats_ || faces_ > (left - floats_ * vertices_) / 2) {
      return error(fmt::format("header declares {} vertices and {} faces, more than the {} bytes that follow can hold",
                               vertices_, faces_, bytes_.size() - at_));
    }
    if (vertices_ > kMaxVertices) return error(fmt::format("{} vertices are too many", vertices_));
    return {};
  }

  Status read_vertices() {
    soup_.vertices.reserve(vertices_);
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      Point p;
      for (double& x : p) {
        const std::uint64_t at = at_;
        x = static_cast<double>(std::bit_cast<float>(next()));
        if (!std::isfinite(x)) return error(fmt::format("vertex {} (byte {} of the numbers) has {}", i, at, x));
      }
      soup_.vertices.push_back(p);
      at_ += kWord * (floats_ - 3);
    }
    return {};
  }

  Status read_face(std::uint64_t face) {
    if (words_left() == 0) return error(fmt::format("file ends at face {} of {}", face, faces_));
    const std::uint32_t size = next();
    if (size >= words_left()) {
      return error(fmt::format("face {} declares {} corners, more than the rest of the file can hold", face, size));
    }
    for (std::uint32_t k = 0; k < size; ++k) {
      const std::uint32_t index = next();
      if (index >= vertices_) return error(fmt::format("face {} uses vertex {} of {}", face, index, vertices_));
      soup_.corners.push_back(index);
    }
    soup_.sizes.push_back(size);
    const std::uint32_t colours = next();
    if (colours > words_left()) {
      return error(fmt::format("face {} declares a colour of {} numbers, more than the rest of the file can hold", face,
                               colours));
    }
    at_ += kWord * colours;
    return {};
  }

  std::string_view bytes_;
  std::uint64_t floats_;  // of a vertex
  const std::string& name_;
  std::uint64_t at_ = 0, vertices_ = 0, faces_ = 0;
  PolygonSoup soup_;
};

}  // namespace

Result<Mesh> read_binary_off(std::string_view bytes, std::string_view keyword, const std::string& name) {
  std::uint64_t floats = 3;
  if (keyword.find('N') != std::string_view::npos) floats += 3;
  if (keyword.find('C') != std::string_view::npos) floats += 4;
  if (keyword.find("ST") != std::string_view::npos) floats += 2;
  BinaryOffReader reader(bytes, floats, name);
  if (keyword.find('n') != std::string_view::npos) {
    if (const Status status = reader.read_dimension(); !status) return status.error();
  }
  return reader.read();
}

}  // namespace medial_vk
