#if defined(MEDIAL_VK_HAS_XML)  // else nothing of tinyxml2 may be needed to build
#include "robots/model/robot_xml.h"

#include <fmt/format.h>

#include "input/text_scanner.h"

namespace medial_vk {

Status parse_robot_xml(std::string_view bytes, const std::string& name, const char* format,
                       tinyxml2::XMLDocument& document) {
  return parse_xml(bytes, name, format, "robot", document);
}

Status read_numbers(const std::string& name, const tinyxml2::XMLElement& element, const char* attribute,
                    std::string_view text, std::span<double> numbers) {
  const auto fault = [&](std::string_view what) {
    const char* hint = text.find("${") == text.npos ? "" : "; expand the file with xacro first";
    return element_error(name, element, fmt::format("{} of <{}>: {}{}", attribute, element.Name(), what, hint));
  };
  TextScanner scanner(text, 0, false);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const std::string_view word = scanner.word_across_lines();
    if (word.empty()) return fault(fmt::format("{} has {} of {} numbers", medial_vk::quoted(text), i, numbers.size()));
    std::string_view why;
    if (!parse_coordinate(word, numbers[i], why)) return fault(fmt::format("{} {}", medial_vk::quoted(word), why));
  }
  if (!scanner.word_across_lines().empty()) {
    return fault(fmt::format("{} has more than {}", medial_vk::quoted(text),
                             numbers.size() == 1 ? "one number" : "three numbers"));
  }
  return {};
}

}  // namespace medial_vk
#endif
