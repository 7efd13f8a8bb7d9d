// OFF as written by Geomview and its successors: an optional keyword with prefixes for extra columns (COFF, NOFF,
// STOFF, CNOFF, ...), three counts, vertices, faces. Further values (normals, colours) on the line of a vertex or a
// face are skipped. nOFF names its dimension after the keyword. Numbers of binary files follow the line of the keyword.
#include <fmt/format.h>

#include "input/polygon_soup.h"
#include "input/readers.h"
#include "input/text_scanner.h"

namespace medial_vk {
namespace {

class OffReader {
 public:
  OffReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), scanner_(bytes, '#', false), name_(name) {}

  Result<Mesh> read() {
    if (const Status status = read_counts(); !status) return status.error();
    if (is_binary_) return read_binary_off(bytes_.substr(bytes_.size() - scanner_.bytes_left()), keyword_, name_);
    if (const Status status = read_vertices(); !status) return status.error();
    if (const Status status = read_faces(); !status) return status.error();
    return triangulate(std::move(soup_));
  }

 private:
  std::string_view next() {
    const std::string_view word = scanner_.word_across_lines();
    line_ = scanner_.line();
    return word;
  }

  Error error(std::string_view what) const { return line_error(name_, line_, what); }

  Status read_counts() {
    std::string_view word = next();
    if (word.ends_with("OFF") || word.ends_with("off")) {
      keyword_ = word;
      word = next();
      is_binary_ = word == "BINARY";
      const bool has_dimension = keyword_.find('n') != std::string_view::npos;
      if (keyword_.find('4') != std::string_view::npos || (has_dimension && !is_binary_ && word != "3")) {
        return error(fmt::format("{}: only three dimensions can be read", quoted(keyword_)));
      }
      if (is_binary_) {
        scanner_.next_line();
        return {};
      }
      if (has_dimension) word = next();
    }
    for (std::uint64_t* count : {&vertices_, &faces_}) {
      std::int64_t value = 0;
      if (word.empty()) return error("file ends before the counts of vertices and faces");
      if (!parse_integer(word, value) || value < 0) {
        return error(fmt::format("{} where a count of vertices or faces should be", quoted(word)));
      }
      *count = static_cast<std::uint64_t>(value);
      if (count == &vertices_) word = next();
    }
    scanner_.next_line();  // the count of edges, which is not needed
    // "0 0 0\n" and "3 0 0 0\n" are the shortest; only a line end may be missing. Tested before memory is allocated.
    constexpr std::uint64_t kVertex = 6, kFace = 2;
    const std::uint64_t left = scanner_.bytes_left() + 1;
    if (vertices_ > left / kVertex || faces_ > (left - kVertex * vertices_) / kFace) {
      return error(fmt::format("header declares {} vertices and {} faces, more than the {} bytes that follow can hold",
                               vertices_, faces_, scanner_.bytes_left()));
    }
    if (vertices_ > kMaxVertices) return error(fmt::format("{} vertices are too many", vertices_));
    return {};
  }

  Status read_vertices() {
    soup_.vertices.reserve(vertices_);
    for (std::uint64_t i = 0; i < vertices_; ++i) {
      Point p;
      for (double& x : p) {
        const std::string_view word = next();
        std::string_view why;
        if (word.empty()) return error(fmt::format("file ends at vertex {} of {}", i, vertices_));
        if (!parse_coordinate(word, x, why)) return error(fmt::format("coordinate {} {}", quoted(word), why));
      }
      soup_.vertices.push_back(p);
      scanner_.next_line();
    }
    return {};
  }

  Status read_faces() {
    for (std::uint64_t i = 0; i < faces_; ++i) {
      std::int64_t size = 0;
      std::string_view word = next();
      if (word.empty()) return error(fmt::format("file ends at face {} of {}", i, faces_));
      if (!parse_integer(word, size) || size < 0) {
        return error(fmt::format("{} where a number of corners should be", quoted(word)));
      }
      if (static_cast<std::uint64_t>(size) > scanner_.bytes_left() / 2 + 1) {
        return error(fmt::format("face declares {} corners, more than the rest of the file can hold", size));
      }
      if (static_cast<std::uint64_t>(size) > kMaxCorners) return error("a face has too many corners");
      for (std::int64_t k = 0; k < size; ++k) {
        std::int64_t index = 0;
        word = next();
        if (word.empty()) return error(fmt::format("file ends in face {} of {}", i, faces_));
        if (!parse_integer(word, index)) return error(fmt::format("face corner {} is not an index", quoted(word)));
        if (index < 0 || index >= static_cast<std::int64_t>(vertices_)) {
          return error(fmt::format("face uses vertex {} of {} (OFF counts from 0)", index, vertices_));
        }
        soup_.corners.push_back(static_cast<std::uint32_t>(index));
      }
      soup_.sizes.push_back(static_cast<std::uint32_t>(size));
      scanner_.next_line();  // colours
    }
    return {};
  }

  std::string_view bytes_;
  TextScanner scanner_;
  const std::string& name_;
  std::string_view keyword_;
  bool is_binary_ = false;
  std::uint64_t line_ = 1, vertices_ = 0, faces_ = 0;
  PolygonSoup soup_;
};

}  // namespace

Result<Mesh> read_off(std::string_view bytes, const std::string& name) { return OffReader(bytes, name).read(); }

}  // namespace medial_vk
