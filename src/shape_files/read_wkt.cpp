#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/quoted.h"
#include "input/text_scanner.h"
#include "shape_files/shape_readers.h"

namespace medial_vk {
namespace {

struct WktFault {
  std::uint64_t line = 0;
  std::string what;
};

constexpr std::array<std::string_view, 10> kWktTypes = {
    "POINT",   "MULTIPOINT",   "LINESTRING", "LINEARRING",         "MULTILINESTRING",
    "POLYGON", "MULTIPOLYGON", "TRIANGLE",   "GEOMETRYCOLLECTION", "SRID"};

bool is_wkt_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_wkt_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

std::string upper_cased(std::string_view word) {
  std::string result(word);
  for (char& c : result) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return result;
}

/// What stands between a word and the first bracket: the number of coordinates of a position, 0 for any.
struct WktType {
  std::string name;
  std::size_t coordinates = 0;
};

class WktReader {
 public:
  explicit WktReader(std::string_view text) : rest_(text) {}

  void read() {
    for (skip_blanks(); !rest_.empty(); skip_blanks()) {
      if (accept(';')) continue;
      const std::string_view word = letters();
      if (upper_cased(word) == "SRID") {
        reference_system();
      } else {
        geometry(word, 0);
      }
    }
  }

  GeometrySet& set() { return set_; }

 private:
  WktFault fault(std::string what) const { return {line_, std::move(what)}; }

  void skip_blanks() {
    while (!rest_.empty() && is_wkt_blank(rest_.front())) {
      if (rest_.front() == '\n') ++line_;
      rest_.remove_prefix(1);
    }
  }

  bool accept(char c) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }

  void expect(char c) {
    if (!accept(c)) throw fault(fmt::format("'{}' is expected before {}", c, here()));
  }

  std::string here() const { return rest_.empty() ? "the end of the file" : quoted(rest_.substr(0, rest_.find('\n'))); }

  std::string_view letters() {
    skip_blanks();
    std::size_t length = 0;
    while (length < rest_.size() && is_wkt_letter(rest_[length])) ++length;
    const std::string_view word = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return word;
  }

  /// The coordinates are those of the plane, whatever reference system the number names.
  void reference_system() {
    expect('=');
    skip_blanks();
    const std::size_t end = rest_.find(';');
    std::int64_t number = 0;
    if (end == std::string_view::npos || !parse_integer(rest_.substr(0, end), number)) {
      throw fault("SRID= is not followed by a whole number and ';'");
    }
    rest_.remove_prefix(end + 1);
  }

  /// "POLYGON", "POLYGON ZM" or "POLYGONZM": the name and the number of coordinates. EMPTY is left for later.
  WktType type_of(std::string_view word) {
    WktType type = {upper_cased(word), 0};
    const auto is_known = [&](const std::string& name) {
      return std::ranges::find(kWktTypes, name) != kWktTypes.end();
    };
    std::string tag;
    if (is_known(type.name)) {
      const std::string_view before = rest_;
      const std::uint64_t line = line_;
      tag = upper_cased(letters());
      if (tag != "Z" && tag != "M" && tag != "ZM") {
        rest_ = before;
        line_ = line;
        return type;
      }
    } else {
      const std::size_t length = type.name.ends_with("ZM") ? 2 : type.name.ends_with('Z') || type.name.ends_with('M');
      tag = type.name.substr(type.name.size() - length);
      type.name.resize(type.name.size() - length);
    }
    if (!is_known(type.name) || type.name == "SRID") {
      if (word.empty()) throw fault(fmt::format("a geometry is expected before {}", here()));
      throw fault(fmt::format("the geometry {} is not supported", quoted(word)));
    }
    type.coordinates = 2 + tag.size();
    return type;
  }

  bool accept_empty() {
    skip_blanks();
    constexpr std::string_view kEmpty = "EMPTY";
    if (upper_cased(rest_.substr(0, kEmpty.size())) != kEmpty) return false;
    rest_.remove_prefix(kEmpty.size());
    return true;
  }

  void geometry(std::string_view word, int depth) {
    const WktType type = type_of(word);
    if (accept_empty()) return;
    const std::string& name = type.name;
    if (name == "POINT" || name == "MULTIPOINT") {
      skip_brackets();
      set_.add_points();
    } else if (name == "LINESTRING" || name == "LINEARRING") {
      set_.add_line(positions(type.coordinates));
    } else if (name == "MULTILINESTRING") {
      list([&] { set_.add_line(positions(type.coordinates)); });
    } else if (name == "POLYGON" || name == "TRIANGLE") {
      polygon(type.coordinates);
    } else if (name == "MULTIPOLYGON") {
      list([&] { polygon(type.coordinates); });
    } else {
      if (depth == kMostNestedCollections) throw fault("collections are nested too deeply");
      list([&] { geometry(letters(), depth + 1); });
    }
  }

  template <class Item>
  void list(const Item& item) {
    expect('(');
    do {
      if (!accept_empty()) item();
    } while (accept(','));
    expect(')');
  }

  void polygon(std::size_t coordinates) {
    std::vector<PlaneRing> rings;
    list([&] { rings.push_back(positions(coordinates)); });
    set_.add_polygon(std::move(rings));
  }

  PlaneRing positions(std::size_t coordinates) {
    PlaneRing ring;
    list([&] { ring.push_back(position(coordinates)); });
    return ring;
  }

  PlanePoint position(std::size_t coordinates) {
    PlanePoint p = {};
    std::size_t count = 0;
    for (;; ++count) {
      skip_blanks();
      if (rest_.empty() || rest_.front() == ',' || rest_.front() == ')') break;
      const double value = number();
      if (count < 2) p[count] = value;
    }
    const bool fine = coordinates == 0 ? count >= 2 && count <= 4 : count == coordinates;
    if (!fine) {
      throw fault(fmt::format("numbers of a position: {} instead of {}", count,
                              coordinates == 0 ? std::string("2 to 4") : std::to_string(coordinates)));
    }
    return p;
  }

  double number() {
    std::size_t length = 0;
    while (length < rest_.size() && !is_wkt_blank(rest_[length]) &&
           std::string_view("(),;").find(rest_[length]) == std::string_view::npos) {
      ++length;
    }
    if (length == 0) throw fault(fmt::format("a number is expected before {}", here()));
    const std::string_view word = rest_.substr(0, length);
    double value = 0;
    std::string_view why;
    if (!parse_coordinate(word, value, why)) throw fault(fmt::format("{} {}", quoted(word), why));
    if (std::fabs(value) > kMostPlaneCoordinate) throw fault(fmt::format("{} is beyond 1e150", quoted(word)));
    rest_.remove_prefix(length);
    return value;
  }

  /// The coordinates of points, with brackets around each one or without.
  void skip_brackets() {
    expect('(');
    for (std::uint64_t open = 1; open > 0;) {
      skip_blanks();
      if (rest_.empty()) throw fault("the file ends within brackets");
      if (accept('(')) {
        ++open;
      } else if (accept(')')) {
        --open;
      } else if (!accept(',') && !accept_empty()) {
        (void)number();
      }
    }
  }

  std::string_view rest_;
  std::uint64_t line_ = 1;
  GeometrySet set_;
};

}  // namespace

bool looks_like_wkt(std::string_view text) {
  std::size_t length = 0;
  while (length < text.size() && is_wkt_letter(text[length])) ++length;
  const std::string word = upper_cased(text.substr(0, std::min<std::size_t>(length, 32)));
  return std::ranges::any_of(kWktTypes, [&](std::string_view type) { return word.starts_with(type); });
}

Result<AreasOfFile> read_wkt(std::string_view bytes, const std::string& name) {
  WktReader reader(bytes);
  try {
    reader.read();
  } catch (const WktFault& fault) {
    return line_error(name, fault.line, fault.what);
  }
  AreasOfFile read;
  read.assumptions = reader.set().assumptions();
  read.closed_lines = reader.set().closed_lines();
  read.areas = reader.set().take_areas();
  return read;
}

}  // namespace medial_vk
