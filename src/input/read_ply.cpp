// PLY (Turk 1994), text and binary. Vertices are the element "vertex" with x, y, z of any type; faces are the elements
// "face" and "tristrips", each with a list vertex_index or vertex_indices. Other elements and properties are skipped.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

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
    int left = (vertex_ != nullptr ? 1 : 0) + (face_ != nullptr ? 1 : 0) + (strips_ != nullptr ? 1 : 0);
    for (const PlyElement& element : header_.elements) {
      const bool is_used = &element == vertex_ || &element == face_ || &element == strips_;
      const Status status = &element == vertex_ ? read_vertices(element)
                            : is_used           ? read_faces(element)
                                                : skip(element);
      if (!status) return status.error();
      if (is_used && --left == 0) break;  // the rest does not matter
    }
    return triangulate(std::move(soup_));
  }

 private:
  /// Before any memory is allocated, tests that the file has the required elements, and room for all that it declares.
  Status check_elements() {
    std::uint64_t room = body_.bytes_left() + 1;  // the last end of line may be missing
    for (const PlyElement& element : header_.elements) {
      const std::uint64_t each = element.smallest_size(header_.format);
      if (each > 0 && element.count > room / each) {
        return file_error(name_,
                          fmt::format("header declares {} elements {}, more than the {} bytes that follow can hold",
                                      element.count, quoted(element.name), body_.bytes_left()));
      }
      room -= each * element.count;
      if (element.name == "vertex" && vertex_ == nullptr) vertex_ = &element;
      if (element.name == "face" && face_ == nullptr) face_ = &element;
      if (element.name == "tristrips" && strips_ == nullptr) strips_ = &element;
    }
    // Some programs declare both elements and leave one of them empty, at times without a property.
    if (face_ != nullptr && face_->count == 0 && strips_ != nullptr) face_ = nullptr;
    if (strips_ != nullptr && strips_->count == 0 && face_ != nullptr) strips_ = nullptr;
    if (vertex_ == nullptr) return file_error(name_, "header declares no element \"vertex\"");
    if (face_ == nullptr && strips_ == nullptr) {
      return file_error(name_, "no faces: header declares no element \"face\" and no element \"tristrips\"");
    }
    return check_properties();
  }

  /// Finds the properties to be read.
  Status check_properties() {
    if (vertex_->count > kMaxVertices)
      return file_error(name_, fmt::format("{} vertices are too many", vertex_->count));
    vertices_ = vertex_->count;
    for (int k = 0; k < 3; ++k) {
      const std::string_view axis = std::string_view("xyz").substr(k, 1);
      axis_[k] = vertex_->find(axis);
      if (axis_[k] < 0 || vertex_->properties[axis_[k]].is_list) {
        return file_error(name_, fmt::format("element \"vertex\" has no property \"{}\"", axis));
      }
    }
    for (const PlyElement* element : {face_, strips_}) {
      if (element != nullptr && indices_of(*element) < 0) {
        return file_error(
            name_, fmt::format("element {} has no list \"vertex_indices\" or \"vertex_index\"", quoted(element->name)));
      }
    }
    return {};
  }

  /// The list of indices among the properties of an element; -1: there is none.
  static int indices_of(const PlyElement& element) {
    const int at = element.find("vertex_indices", "vertex_index");
    return at >= 0 && element.properties[at].is_list ? at : -1;
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

  /// Of the faces or of the strips.
  Status read_faces(const PlyElement& element) {
    const int indices = indices_of(element);
    const bool is_strips = &element == strips_;
    if (!is_strips) {
      soup_.sizes.reserve(soup_.sizes.size() + element.count);
      soup_.corners.reserve(soup_.corners.size() + 3 * element.count);
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (int at = 0; at < static_cast<int>(element.properties.size()); ++at) {
        const PlyProperty& property = element.properties[at];
        Status status;
        if (at != indices) {
          status = body_.skip(property);
        } else {
          status = is_strips ? read_strips(i, property) : read_face(i, property);
        }
        if (!status) return status;
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
      if (!is_vertex(value)) return index_error("face", face, value);
      soup_.corners.push_back(static_cast<std::uint32_t>(value.integer));
    }
    soup_.sizes.push_back(static_cast<std::uint32_t>(size));
    return {};
  }

  /// One list holds any number of strips, which -1 divides. In a strip every vertex after the second makes a triangle
  /// with the two before it. Every second triangle is turned over, so that all of a strip have the same orientation.
  Status read_strips(std::uint64_t list, const PlyProperty& property) {
    std::uint64_t size = 0;
    if (Status status = body_.read_length(property, size); !status) return status;
    std::uint32_t before[2] = {0, 0};
    std::uint64_t length = 0;  // of the present strip
    const auto end_strip = [&] {
      if (length == 1 || length == 2) add_polygon({before + 2 - length, before + 2});
      length = 0;
    };
    for (std::uint64_t k = 0; k < size; ++k) {
      PlyValue value;
      if (Status status = body_.read(property.type, value); !status) return status;
      if (value.is_integer && value.integer == -1) {
        end_strip();
        continue;
      }
      if (!is_vertex(value)) return index_error("strip list", list, value);
      const auto vertex = static_cast<std::uint32_t>(value.integer);
      // A repeated vertex leads the strip to another place or turns it over: it makes no face.
      const bool is_joint = before[0] == before[1] || before[0] == vertex || before[1] == vertex;
      if (length >= 2 && !is_joint) {
        const std::uint32_t corners[] = {before[length % 2], before[1 - length % 2], vertex};
        add_polygon(corners);
      }
      before[0] = std::exchange(before[1], vertex);
      ++length;
    }
    end_strip();
    return {};
  }

  void add_polygon(std::span<const std::uint32_t> corners) {
    soup_.corners.insert(soup_.corners.end(), corners.begin(), corners.end());
    soup_.sizes.push_back(static_cast<std::uint32_t>(corners.size()));
  }

  bool is_vertex(const PlyValue& value) const {
    return value.is_integer && value.integer >= 0 && value.integer < static_cast<std::int64_t>(vertices_);
  }

  Error index_error(const char* where, std::uint64_t number, const PlyValue& value) const {
    const std::string index = value.is_integer ? fmt::format("{}", value.integer) : fmt::format("{}", value.real);
    return body_.error(fmt::format("{} {} uses vertex {} of {}", where, number, index, vertices_));
  }

  PlyHeader header_;
  PlyBody body_;
  const std::string& name_;
  std::uint64_t vertices_ = 0;
  const PlyElement *vertex_ = nullptr, *face_ = nullptr, *strips_ = nullptr;  // of header_; null: not there
  int axis_[3] = {-1, -1, -1};
  PolygonSoup soup_;
};

}  // namespace

Result<Mesh> read_ply(std::string_view bytes, const std::string& name) {
  Result<PlyHeader> header = parse_ply_header(bytes, name);
  if (!header.ok()) return header.error();
  return PlyReader(bytes, name, std::move(header.value())).read();
}

}  // namespace medial_vk
