// Wavefront OBJ: v and f, and fo, the older name of f; all other lines are skipped. Indices count from 1, or back from
// the last vertex if negative, and may carry texture and normal indices behind slashes.
#include <fmt/format.h>

#include "input/polygon_soup.h"
#include "input/readers.h"
#include "input/text_scanner.h"

namespace medial_vk {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name) : scanner_(bytes, '#', true), name_(name) {}

  Result<Mesh> read() {
    do {
      const std::string_view keyword = scanner_.word();
      Status status;
      if (keyword == "v") status = read_vertex();
      if (keyword == "f" || keyword == "fo") status = read_face();
      if (keyword == "surf") has_surfaces_ = true;
      if (!status) return status.error();
    } while (scanner_.next_line());
    // A face may name later vertices; only at the end is their number known.
    for (const Forward& f : forward_) {
      if (f.vertex > soup_.vertices.size()) return index_error(f.line, static_cast<std::int64_t>(f.vertex));
    }
    if (soup_.sizes.empty() && has_surfaces_) {
      return file_error(name_, "no faces: it holds free-form surfaces only; export it as polygons");
    }
    return triangulate(std::move(soup_));
  }

 private:
  struct Forward {
    std::uint64_t line;
    std::uint64_t vertex;  // from 1
  };

  Error index_error(std::uint64_t line, std::int64_t vertex) const {
    return line_error(name_, line, fmt::format("face uses vertex {} of {}", vertex, soup_.vertices.size()));
  }

  Status read_vertex() {
    Point p;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = scanner_.word();
      if (word.empty()) return line_error(name_, scanner_.line(), fmt::format("vertex has {} coordinates of 3", k));
      std::string_view why;
      if (!parse_coordinate(word, p[k], why)) {
        return line_error(name_, scanner_.line(), fmt::format("coordinate {} {}", quoted(word), why));
      }
    }
    if (soup_.vertices.size() == kMaxVertices) return line_error(name_, scanner_.line(), "too many vertices");
    soup_.vertices.push_back(p);  // a fourth number is a weight, further ones are colours
    return {};
  }

  Status read_face() {
    std::uint32_t size = 0;
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word(), ++size) {
      std::int64_t index = 0;
      if (!parse_integer(word.substr(0, word.find('/')), index)) {
        return line_error(name_, scanner_.line(), fmt::format("face corner {} is not an index", quoted(word)));
      }
      const auto count = static_cast<std::int64_t>(soup_.vertices.size());
      if (index == 0) return line_error(name_, scanner_.line(), "face uses vertex 0; OBJ counts from 1");
      if (index < -count || index > static_cast<std::int64_t>(kMaxVertices)) {
        return index_error(scanner_.line(), index);
      }
      if (index < 0) index += count + 1;
      if (size == kMaxCorners) return line_error(name_, scanner_.line(), "a face has too many corners");
      if (index > count) forward_.push_back({scanner_.line(), static_cast<std::uint64_t>(index)});
      soup_.corners.push_back(static_cast<std::uint32_t>(index - 1));
    }
    soup_.sizes.push_back(size);
    return {};
  }

  TextScanner scanner_;
  const std::string& name_;
  PolygonSoup soup_;
  std::vector<Forward> forward_;
  bool has_surfaces_ = false;
};

}  // namespace

Result<Mesh> read_obj(std::string_view bytes, const std::string& name) { return ObjReader(bytes, name).read(); }

}  // namespace medial_vk
