// STL, text and binary. The format repeats every corner: equal ones become one vertex. Its normals are often wrong or
// zero and are not read; the order of the corners determines the orientation.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "input/polygon_soup.h"
#include "input/readers.h"
#include "input/text_scanner.h"
#include "mesh/clean_mesh.h"

namespace medial_vk {
namespace {

constexpr std::uint64_t kHeaderSize = 84;
constexpr std::uint64_t kFacetSize = 50;

template <class T>
T read_little_endian(const char* at) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) {
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  }
  return std::bit_cast<T>(bytes);
}

std::uint64_t declared_facets(std::string_view bytes) { return read_little_endian<std::uint32_t>(bytes.data() + 80); }

bool equals_ignoring_case(std::string_view word, std::string_view lower) {
  if (word.size() != lower.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char c = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
    if (c != lower[i]) return false;
  }
  return true;
}

class AsciiStlReader {
 public:
  AsciiStlReader(std::string_view bytes, const std::string& name) : scanner_(bytes, 0, false), name_(name) {}

  Result<Mesh> read() {
    for (std::string_view word = next(); !word.empty(); word = next()) {
      if (!equals_ignoring_case(word, "facet")) {  // solid NAME, endsolid NAME, or an exporter's own line
        scanner_.next_line();
        continue;
      }
      if (const Status status = read_facet(); !status) return status.error();
    }
    Mesh mesh = triangulate(std::move(soup_));
    merge_equal_vertices(mesh);
    return mesh;
  }

 private:
  std::string_view next() {
    const std::string_view word = scanner_.word_across_lines();
    line_ = scanner_.line();
    return word;
  }

  Error error(std::string_view what) const { return line_error(name_, line_, what); }

  Status expect(std::string_view wanted) {
    const std::string_view word = next();
    if (equals_ignoring_case(word, wanted)) return {};
    if (word.empty()) return error(fmt::format("file ends inside facet {}", soup_.sizes.size()));
    return error(fmt::format("{} where \"{}\" should be", quoted(word), wanted));
  }

  Status read_facet() {
    if (Status status = expect("normal"); !status) return status;
    for (int k = 0; k < 3; ++k) next();
    for (const std::string_view word : {"outer", "loop"}) {
      if (Status status = expect(word); !status) return status;
    }
    std::uint32_t size = 0;
    std::string_view word = next();
    for (; equals_ignoring_case(word, "vertex"); word = next(), ++size) {
      Point p;
      for (double& x : p) {
        const std::string_view number = next();
        std::string_view why;
        if (number.empty()) return error(fmt::format("file ends inside facet {}", soup_.sizes.size()));
        if (!parse_coordinate(number, x, why)) return error(fmt::format("coordinate {} {}", quoted(number), why));
      }
      if (soup_.vertices.size() == kMaxVertices) return error("too many vertices");
      soup_.corners.push_back(static_cast<std::uint32_t>(soup_.vertices.size()));
      soup_.vertices.push_back(p);
    }
    if (!equals_ignoring_case(word, "endloop")) {
      if (word.empty()) return error(fmt::format("file ends inside facet {}", soup_.sizes.size()));
      return error(fmt::format("{} where \"vertex\" or \"endloop\" should be", quoted(word)));
    }
    if (size < 3) return error(fmt::format("facet has {} vertices", size));
    soup_.sizes.push_back(size);
    return expect("endfacet");
  }

  TextScanner scanner_;
  const std::string& name_;
  std::uint64_t line_ = 1;
  PolygonSoup soup_;
};

}  // namespace

bool has_size_of_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeaderSize && bytes.size() == kHeaderSize + kFacetSize * declared_facets(bytes);
}

Result<Mesh> read_ascii_stl(std::string_view bytes, const std::string& name) {
  return AsciiStlReader(bytes, name).read();
}

Result<Mesh> read_binary_stl(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kHeaderSize) {
    return file_error(
        name, fmt::format("{} bytes are too few for a binary STL, whose header takes {}", bytes.size(), kHeaderSize));
  }
  const std::uint64_t facets = declared_facets(bytes);
  if (bytes.size() < kHeaderSize + kFacetSize * facets) {
    return file_error(name, fmt::format("header declares {} triangles, which take {} bytes, but the file has {}",
                                        facets, kHeaderSize + kFacetSize * facets, bytes.size()));
  }
  if (3 * facets > kMaxVertices) return file_error(name, fmt::format("{} triangles are too many", facets));
  Mesh mesh;
  mesh.vertices.reserve(3 * facets);
  mesh.triangles.reserve(facets);
  for (std::uint64_t facet = 0; facet < facets; ++facet) {
    const std::uint64_t start = kHeaderSize + kFacetSize * facet + 12;  // after the normal
    for (std::uint64_t corner = 0; corner < 3; ++corner) {
      Point p;
      for (std::uint64_t k = 0; k < 3; ++k) {
        const std::uint64_t at = start + 12 * corner + 4 * k;
        p[k] = read_little_endian<float>(bytes.data() + at);
        if (!std::isfinite(p[k])) {
          return file_error(name, fmt::format("triangle {} (byte {}) has the coordinate {}", facet, at, p[k]));
        }
      }
      mesh.vertices.push_back(p);
    }
    const auto first = static_cast<std::uint32_t>(3 * facet);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  merge_equal_vertices(mesh);
  return mesh;
}

}  // namespace medial_vk
