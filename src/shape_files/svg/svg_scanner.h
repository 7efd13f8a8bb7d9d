// Numbers and words of the attributes of SVG, which may follow one another without a separator: "1-2.5e3.5".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace medial_vk {

/// What is wrong with an element; the reader adds the name of the element and its line.
struct SvgFault {
  std::string what;
};

class SvgScanner {
 public:
  explicit SvgScanner(std::string_view text) : rest_(text) { skip_blanks(); }

  bool at_end() const { return rest_.empty(); }
  /// The next character, 0 at the end.
  char next() const { return rest_.empty() ? '\0' : rest_.front(); }
  std::string_view rest() const { return rest_; }
  /// Skips one character and the blanks after it.
  void step();
  /// Skips the character if it is the next one, and the blanks after it.
  bool accept(char c);
  bool starts_number() const;
  /// A number, and the separator after it: blanks and at most one comma. Throws SvgFault.
  double number();
  /// The same, without the separator: a unit may follow.
  double number_before_unit();
  /// A 0 or a 1 in the data of an arc, which need no separator. Throws SvgFault.
  bool flag();
  /// Letters and %, maybe none; no blanks are skipped.
  std::string_view letters();
  void skip_blanks();

 private:
  void skip_separator();

  std::string_view rest_;
};

bool is_svg_blank(char c);
/// Without the blanks around it.
std::string_view without_svg_blanks(std::string_view text);

/// All numbers of a text. Throws SvgFault.
std::vector<double> svg_numbers(std::string_view text);

}  // namespace medial_vk
