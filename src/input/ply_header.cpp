#include "input/ply_header.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "input/text_scanner.h"

namespace medial_vk {
namespace {

std::optional<PlyType> parse_type(std::string_view word) {
  static constexpr std::pair<std::string_view, PlyType> kTypes[] = {
      {"char", PlyType::kInt8},     {"int8", PlyType::kInt8},     {"uchar", PlyType::kUint8},
      {"uint8", PlyType::kUint8},   {"short", PlyType::kInt16},   {"int16", PlyType::kInt16},
      {"ushort", PlyType::kUint16}, {"uint16", PlyType::kUint16}, {"int", PlyType::kInt32},
      {"int32", PlyType::kInt32},   {"uint", PlyType::kUint32},   {"uint32", PlyType::kUint32},
      {"int64", PlyType::kInt64},   {"uint64", PlyType::kUint64}, {"float", PlyType::kFloat},
      {"float32", PlyType::kFloat}, {"double", PlyType::kDouble}, {"float64", PlyType::kDouble}};
  for (const auto& [name, type] : kTypes) {
    if (name == word) return type;
  }
  return std::nullopt;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name)
      : bytes_(bytes), scanner_(bytes, 0, false), name_(name) {}

  Result<PlyHeader> parse() {
    if (scanner_.word() != "ply") return error("a PLY file begins with the line \"ply\"");
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.word();
      Status status;
      if (keyword == "end_header") return finish();
      if (keyword == "format") {
        status = parse_format();
      } else if (keyword == "element") {
        status = parse_element();
      } else if (keyword == "property") {
        status = parse_property();
      } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
        status = error(fmt::format("{} is no keyword of a PLY header", quoted(keyword)));
      }
      if (!status) return status.error();
    }
    return error("file ends inside the header (no \"end_header\")");
  }

 private:
  Error error(std::string_view what) const { return line_error(name_, scanner_.line(), what); }

  Result<PlyHeader> finish() {
    if (!has_format_) return error("the header has no \"format\" line");
    // Data may begin with any byte, so this line must end in the same way as the first one.
    const std::size_t first_end = bytes_.find_first_of("\r\n");
    const bool has_pair = bytes_.substr(first_end, 2) == "\r\n";
    std::size_t end = bytes_.size() - scanner_.bytes_left();
    while (end < bytes_.size() && bytes_[end] != bytes_[first_end]) ++end;  // trailing blanks
    end += has_pair && bytes_.substr(end, 2) == "\r\n" ? 2 : 1;
    if (end > bytes_.size()) end = bytes_.size();
    header_.body = end;
    header_.body_line = scanner_.line() + 1;
    return std::move(header_);
  }

  Status parse_format() {
    const std::string_view word = scanner_.word();
    if (word == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (word == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (word == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      return error(fmt::format("format {} is unknown", quoted(word)));
    }
    has_format_ = true;
    return {};
  }

  Status parse_element() {
    PlyElement element;
    element.name = scanner_.word();
    const std::string_view word = scanner_.word();
    std::int64_t count = 0;
    if (!parse_integer(word, count) || count < 0) {
      return error(fmt::format("{} is no count of {} elements", quoted(word), quoted(element.name)));
    }
    element.count = static_cast<std::uint64_t>(count);
    header_.elements.push_back(std::move(element));
    return {};
  }

  Status parse_property() {
    if (header_.elements.empty()) return error("property before the first element");
    PlyProperty property;
    std::string_view word = scanner_.word();
    if (word == "list") {
      property.is_list = true;
      word = scanner_.word();
      const auto count_type = parse_type(word);
      if (!count_type || *count_type == PlyType::kFloat || *count_type == PlyType::kDouble) {
        return error(fmt::format("{} is no integer type for the length of a list", quoted(word)));
      }
      property.count_type = *count_type;
      word = scanner_.word();
    }
    const auto type = parse_type(word);
    if (!type) return error(fmt::format("{} is no type of a PLY property", quoted(word)));
    property.type = *type;
    property.name = scanner_.word();
    if (property.name.empty()) return error("property without a name");
    header_.elements.back().properties.push_back(std::move(property));
    return {};
  }

  std::string_view bytes_;
  TextScanner scanner_;
  const std::string& name_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

std::uint64_t size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat:
      return 4;
    case PlyType::kInt64:
    case PlyType::kUint64:
    case PlyType::kDouble:
      return 8;
  }
  return 0;
}

int PlyElement::find(std::string_view property_name, std::string_view other_name) const {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (properties[i].name == property_name || (!other_name.empty() && properties[i].name == other_name)) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

std::uint64_t PlyElement::smallest_size(PlyFormat format) const {
  if (format == PlyFormat::kAscii) return 2 * properties.size();  // a digit and a separator
  std::uint64_t size = 0;
  for (const PlyProperty& p : properties) size += size_of(p.is_list ? p.count_type : p.type);
  return size;
}

Result<PlyHeader> parse_ply_header(std::string_view bytes, const std::string& name) {
  return HeaderParser(bytes, name).parse();
}

}  // namespace medial_vk
