// PLY (Turk 1994), text and binary. Vertices are the element "vertex" with x, y, z of any type; faces are the element
// "face" with a list vertex_index or vertex_indices. Other elements and properties are skipped.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>

#include "input/ply_header.h"
#include "input/polygon_soup.h"
#include "input/readers.h"
#include "input/text_scanner.h"

namespace medial_vk {
namespace {

/// A value of any type: floating types as a double, integer types exactly.
struct PlyValue {
  double real = 0;
  std::int64_t integer = 0;
  bool is_integer = false;  ///< `integer` holds it (a whole number written as a float counts as one).
};

/// Converts the bits of a value.
PlyValue value_of(PlyType type, std::uint64_t bits) {
  const auto integer = [](std::int64_t i) { return PlyValue{static_cast<double>(i), i, true}; };
  const auto real = [](double d) {
    const bool is_whole = std::abs(d) < 0x1p53 && d == std::floor(d);
    return PlyValue{d, is_whole ? static_cast<std::int64_t>(d) : 0, is_whole};
  };
  switch (type) {
    case PlyType::kInt8:
      return integer(static_cast<std::int8_t>(bits));
    case PlyType::kUint8:
      return integer(static_cast<std::uint8_t>(bits));
    case PlyType::kInt16:
      return integer(static_cast<std::int16_t>(bits));
    case PlyType::kUint16:
      return integer(static_cast<std::uint16_t>(bits));
    case PlyType::kInt32:
      return integer(static_cast<std::int32_t>(bits));
    case PlyType::kUint32:
      return integer(static_cast<std::uint32_t>(bits));
    case PlyType::kInt64:
      return integer(static_cast<std::int64_t>(bits));
    case PlyType::kUint64:
      if (bits >> 63 != 0) return {static_cast<double>(bits), 0, false};
      return integer(static_cast<std::int64_t>(bits));
    case PlyType::kFloat:
      return real(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case PlyType::kDouble:
      return real(std::bit_cast<double>(bits));
  }
  return {};
}

/// Reads values in sequence, from either kind of body.
class PlyBody {
 public:
  PlyBody(std::string_view bytes, const PlyHeader& header, const std::string& name)
      : bytes_(bytes),
        format_(header.format),
        name_(name),
        at_(header.body),
        scanner_(bytes.substr(header.body), 0, false),
        first_line_(header.body_line) {}

  std::uint64_t bytes_left() const {
    return format_ == PlyFormat::kAscii ? scanner_.bytes_left() : bytes_.size() - at_;
  }

  /// An error at the last value read: "name:line: what", or "name: what (byte N)".
  Error error(std::string_view what) const {
    if (format_ == PlyFormat::kAscii) return line_error(name_, first_line_ + scanner_.line() - 1, what);
    return file_error(name_, fmt::format("{} (byte {})", what, last_));
  }

  Status read(PlyType type, PlyValue& value) {
    if (format_ == PlyFormat::kAscii) return read_word(type, value);
    last_ = at_;
    const std::uint64_t size = size_of(type);
    if (size > bytes_.size() - at_) return error("file ends too early");
    std::uint64_t bits = 0;
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::uint64_t byte = static_cast<unsigned char>(bytes_[at_ + i]);
      bits = format_ == PlyFormat::kLittleEndian ? bits | byte << (8 * i) : bits << 8 | byte;
    }
    at_ += size;
    value = value_of(type, bits);
    return {};
  }

  Status skip(const PlyProperty& property) {
    PlyValue value;
    if (!property.is_list) return read(property.type, value);
    std::uint64_t length = 0;
    if (Status status = read_length(property, length); !status) return status;
    if (format_ != PlyFormat::kAscii) {
      at_ += length * size_of(property.type);
      return {};
    }
    for (std::uint64_t i = 0; i < length; ++i) {
      if (Status status = read(property.type, value); !status) return status;
    }
    return {};
  }

  /// The length of a list, tested against the rest of the file.
  Status read_length(const PlyProperty& property, std::uint64_t& length) {
    PlyValue value;
    if (Status status = read(property.count_type, value); !status) return status;
    if (!value.is_integer || value.integer < 0) return error(fmt::format("a list has the length {}", value.real));
    length = static_cast<std::uint64_t>(value.integer);
    const bool is_text = format_ == PlyFormat::kAscii;
    const std::uint64_t room = is_text ? (bytes_left() + 1) / 2 : bytes_left() / size_of(property.type);
    if (length > room) {
      return error(fmt::format("a list of {} values is longer than the rest of the file", length));
    }
    return {};
  }

 private:
  Status read_word(PlyType type, PlyValue& value) {
    const std::string_view word = scanner_.word_across_lines();
    if (word.empty()) return error("file ends too early");
    if (parse_integer(word, value.integer)) {
      value.is_integer = true;
      if (type != PlyType::kFloat && type != PlyType::kDouble) {
        value.real = static_cast<double>(value.integer);
        return {};
      }
    } else {
      value.is_integer = false;
    }
    std::string_view why;
    if (!parse_coordinate(word, value.real, why)) {
      // The caller tests that values are finite: in an unused property it does not matter.
      if (why == "is not a number") return error(fmt::format("{} {}", quoted(word), why));
      value.real = std::numeric_limits<double>::quiet_NaN();
    }
    if (!value.is_integer && std::abs(value.real) < 0x1p53 && value.real == std::floor(value.real)) {
      value.integer = static_cast<std::int64_t>(value.real);
      value.is_integer = true;
    }
    return {};
  }

  std::string_view bytes_;
  PlyFormat format_;
  const std::string& name_;
  std::uint64_t at_, last_ = 0;
  TextScanner scanner_;
  std::uint64_t first_line_;
};

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& name, PlyHeader header)
      : header_(std::move(header)), body_(bytes, header_, name), name_(name) {}

  Result<Mesh> read() {
    if (const Status status = check_elements(); !status) return status.error();
    bool has_vertices = false, has_faces = false;
    for (const PlyElement& element : header_.elements) {
      const bool is_vertex = element.name == "vertex" && !has_vertices;
      const bool is_face = element.name == "face" && !has_faces;
      const Status status = is_vertex ? read_vertices(element) : is_face ? read_faces(element) : skip(element);
      if (!status) return status.error();
      has_vertices = has_vertices || is_vertex;
      has_faces = has_faces || is_face;
      if (has_vertices && has_faces) break;  // the rest does not matter
    }
    return triangulate(std::move(soup_));
  }

 private:
  /// Before any memory is allocated, tests that the file has the required elements, and room for all that it declares.
  Status check_elements() {
    std::uint64_t room = body_.bytes_left() + 1;  // the last end of line may be missing
    const PlyElement *vertex = nullptr, *face = nullptr;
    for (const PlyElement& element : header_.elements) {
      const std::uint64_t each = element.smallest_size(header_.format);
      if (each > 0 && element.count > room / each) {
        return file_error(name_,
                          fmt::format("header declares {} elements {}, more than the {} bytes that follow can hold",
                                      element.count, quoted(element.name), body_.bytes_left()));
      }
      room -= each * element.count;
      if (element.name == "vertex" && vertex == nullptr) vertex = &element;
      if (element.name == "face" && face == nullptr) face = &element;
      if (element.name == "tristrips" && face == nullptr) {
        return file_error(name_, "holds triangle strips, which are not read; save it with faces");
      }
    }
    if (vertex == nullptr) return file_error(name_, "header declares no element \"vertex\"");
    if (face == nullptr) return file_error(name_, "no faces: header declares no element \"face\"");
    if (vertex->count > kMaxVertices) return file_error(name_, fmt::format("{} vertices are too many", vertex->count));
    vertices_ = vertex->count;
    for (int k = 0; k < 3; ++k) {
      const std::string_view axis = std::string_view("xyz").substr(k, 1);
      axis_[k] = vertex->find(axis);
      if (axis_[k] < 0 || vertex->properties[axis_[k]].is_list) {
        return file_error(name_, fmt::format("element \"vertex\" has no property \"{}\"", axis));
      }
    }
    indices_ = face->find("vertex_indices", "vertex_index");
    if (indices_ < 0 || !face->properties[indices_].is_list) {
      return file_error(name_, "element \"face\" has no list \"vertex_indices\" or \"vertex_index\"");
    }
    return {};
  }

  Status skip(const PlyElement& element) {
    if (element.properties.empty()) return {};
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (Status status = body_.skip(property); !status) return status;
      }
    }
    return {};
  }

  Status read_vertices(const PlyElement& element) {
    soup_.vertices.reserve(element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      Point p = {0, 0, 0};
      for (int at = 0; at < static_cast<int>(element.properties.size()); ++at) {
        const PlyProperty& property = element.properties[at];
        int k = 0;
        while (k < 3 && axis_[k] != at) ++k;
        if (k == 3) {
          if (Status status = body_.skip(property); !status) return status;
          continue;
        }
        PlyValue value;
        if (Status status = body_.read(property.type, value); !status) return status;
        if (!std::isfinite(value.real)) {
          return body_.error(
              fmt::format("vertex {}: {} is not finite or beyond the range of a double", i, property.name));
        }
        p[k] = value.real;
      }
      soup_.vertices.push_back(p);
    }
    return {};
  }

  Status read_faces(const PlyElement& element) {
    soup_.sizes.reserve(element.count);
    soup_.corners.reserve(3 * element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (int at = 0; at < static_cast<int>(element.properties.size()); ++at) {
        const PlyProperty& property = element.properties[at];
        if (Status status = at == indices_ ? read_face(i, property) : body_.skip(property); !status) return status;
      }
    }
    return {};
  }

  Status read_face(std::uint64_t face, const PlyProperty& property) {
    std::uint64_t size = 0;
    if (Status status = body_.read_length(property, size); !status) return status;
    if (size > kMaxCorners) return body_.error("a face has too many corners");
    for (std::uint64_t k = 0; k < size; ++k) {
      PlyValue value;
      if (Status status = body_.read(property.type, value); !status) return status;
      if (!value.is_integer || value.integer < 0 || value.integer >= static_cast<std::int64_t>(vertices_)) {
        const std::string index = value.is_integer ? fmt::format("{}", value.integer) : fmt::format("{}", value.real);
        return body_.error(fmt::format("face {} uses vertex {} of {}", face, index, vertices_));
      }
      soup_.corners.push_back(static_cast<std::uint32_t>(value.integer));
    }
    soup_.sizes.push_back(static_cast<std::uint32_t>(size));
    return {};
  }

  PlyHeader header_;
  PlyBody body_;
  const std::string& name_;
  std::uint64_t vertices_ = 0;
  int axis_[3] = {-1, -1, -1};
  int indices_ = -1;
  PolygonSoup soup_;
};

}  // namespace

Result<Mesh> read_ply(std::string_view bytes, const std::string& name) {
  Result<PlyHeader> header = parse_ply_header(bytes, name);
  if (!header.ok()) return header.error();
  return PlyReader(bytes, name, std::move(header.value())).read();
}

}  // namespace medial_vk
