#include "support/hulls/usd_text.h"

#include <cctype>
#include <charconv>
#include <stdexcept>

namespace medial_vk::test {
namespace {

class UsdReader {
 public:
  explicit UsdReader(const std::string& text) : text_(text) {}

  UsdLayer layer() {
    if (!text_.starts_with("#usda 1.0\n")) fail("the first line is not '#usda 1.0'");
    at_ = 10;
    UsdLayer layer;
    if (next_is('(')) layer.metadata = metadata();
    while (!is_at_end()) layer.prims.push_back(prim());
    return layer;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error("USD, byte " + std::to_string(at_) + ": " + what);
  }

  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool is_at_end() {
    skip_blanks();
    return at_ == text_.size();
  }
  bool next_is(char c) {
    skip_blanks();
    return at_ < text_.size() && text_[at_] == c;
  }
  void expect(char c) {
    if (!next_is(c)) fail(std::string("no '") + c + "'");
    ++at_;
  }
  bool take(char c) {
    if (!next_is(c)) return false;
    ++at_;
    return true;
  }

  static bool is_of_identifier(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

  /// Identifiers with colons between them.
  std::string word() {
    skip_blanks();
    const std::size_t begin = at_;
    while (at_ < text_.size() && (is_of_identifier(text_[at_]) || text_[at_] == ':')) ++at_;
    const std::string word = text_.substr(begin, at_ - begin);
    if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0])) != 0) fail("no name");
    return word;
  }

  std::string quoted() {
    expect('"');
    const std::size_t end = text_.find_first_of("\"\\\n", at_);
    if (end == std::string::npos || text_[end] != '"') fail("a string does not end in its line");
    const std::string inside = text_.substr(at_, end - at_);
    at_ = end + 1;
    return inside;
  }

  UsdValue value() {
    UsdValue value;
    if (next_is('"')) {
      value.type = UsdValue::Type::kString;
      value.text = quoted();
    } else if (next_is('(')) {
      value.type = UsdValue::Type::kTuple;
      value.items = items('(', ')');
    } else if (next_is('[')) {
      value.type = UsdValue::Type::kList;
      value.items = items('[', ']');
    } else {
      const char* begin = text_.data() + at_;
      const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value.number);
      if (error != std::errc()) fail("no value");
      at_ += static_cast<std::size_t>(end - begin);
    }
    return value;
  }

  std::vector<UsdValue> items(char open, char close) {
    expect(open);
    std::vector<UsdValue> all;
    while (!take(close)) {
      if (!all.empty()) expect(',');
      all.push_back(value());
    }
    return all;
  }

  std::map<std::string, UsdValue> metadata() {
    std::map<std::string, UsdValue> all;
    expect('(');
    while (!take(')')) {
      std::string name = word();
      if (name == "prepend") name = word();
      expect('=');
      if (!all.emplace(name, value()).second) fail(name + " is there twice");
    }
    return all;
  }

  UsdPrim prim() {
    if (word() != "def") fail("no prim");
    return rest_of_prim();
  }

  UsdPrim rest_of_prim() {
    UsdPrim prim;
    prim.type = word();
    prim.name = quoted();
    if (prim.name.empty() || std::isdigit(static_cast<unsigned char>(prim.name[0])) != 0) fail("no name of a prim");
    for (const char c : prim.name) {
      if (!is_of_identifier(c)) fail("'" + prim.name + "' is no name of a prim");
    }
    if (next_is('(')) prim.metadata = metadata();
    expect('{');
    while (!take('}')) member_of(prim);
    return prim;
  }

  void member_of(UsdPrim& prim) {
    UsdProperty property;
    property.type = word();
    if (property.type == "def") {
      prim.children.push_back(rest_of_prim());
      return;
    }
    if (property.type == "uniform") {
      property.is_uniform = true;
      property.type = word();
    }
    if (take('[')) {
      expect(']');
      property.type += "[]";
    }
    const std::string name = word();
    expect('=');
    property.value = value();
    if (!prim.properties.emplace(name, std::move(property)).second) fail(name + " is there twice");
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<double> UsdValue::numbers() const {
  std::vector<double> all;
  for (const UsdValue& item : items) all.push_back(item.number);
  return all;
}

UsdLayer parse_usd(const std::string& text) { return UsdReader(text).layer(); }

}  // namespace medial_vk::test
