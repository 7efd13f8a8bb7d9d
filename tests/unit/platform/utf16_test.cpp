#include "platform/utf16.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>

#include "platform/paths.h"

namespace medial_vk::platform {
namespace {

TEST(Utf16, CharactersOfEveryLength) {
  const std::pair<std::string, std::u16string> same[] = {
      {"", u""},
      {std::string("a\0b", 3), std::u16string(u"a\0b", 3)},
      {"\x7f\xc2\x80\xdf\xbf\xe0\xa0\x80", u"\u007f\u0080\u07ff\u0800"},
      {"\xed\x9f\xbf\xee\x80\x80\xef\xbf\xbf", u"\ud7ff\ue000\uffff"},
      {"\xf0\x90\x80\x80\xf0\x9f\x90\xa2\xf4\x8f\xbf\xbf", u"\U00010000\U0001f422\U0010ffff"}};
  for (const auto& [utf8, utf16] : same) {
    EXPECT_EQ(utf16_of(utf8), utf16) << utf8;
    EXPECT_EQ(utf8_of(utf16), utf8) << utf8;
  }
}

// File systems of Windows do not check that names are well-formed.
TEST(Utf16, AnyUnitsComeBack) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    std::u16string units(random() % 6, u'a');
    for (char16_t& unit : units) {
      const bool is_half = random() % 2 == 0;
      unit = static_cast<char16_t>(is_half ? 0xd800 + random() % 0x800 : random() % 0x10000);
    }
    ASSERT_EQ(utf16_of(utf8_of(units)), units);
  }
}

TEST(Utf16, BytesOfNoCharacterAreReplacedOneByOne) {
  const std::pair<std::string, std::u16string> replaced[] = {
      {"caf\xe9.obj", u"caf\ufffd.obj"},  // Latin-1
      {"\xc3", u"\ufffd"},                // cut off
      {"\xf0\x9f\x90", u"\ufffd\ufffd\ufffd"},
      {"\x80z\xbf", u"\ufffdz\ufffd"},
      {"\xc0\xaf", u"\ufffd\ufffd"},  // a longer form of another character: "/"
      {"\xe0\x80\xaf", u"\ufffd\ufffd\ufffd"},
      {"\xf4\x90\x80\x80", u"\ufffd\ufffd\ufffd\ufffd"},  // beyond the last character
      {"\xff\xfe", u"\ufffd\ufffd"}};
  for (const auto& [utf8, utf16] : replaced) EXPECT_EQ(utf16_of(utf8), utf16) << utf8;
}

// A name that is no UTF-8 is one of another system, or of none; in either case no exception.
TEST(Utf16, PathsAreMadeOfAnyBytes) {
  std::mt19937 random(2);
  for (int i = 0; i < 2000; ++i) {
    std::string bytes(random() % 12, ' ');
    for (char& byte : bytes) byte = static_cast<char>(random() % 255 + 1);
    EXPECT_NO_THROW(text_of(path_of(bytes)));
  }
}

}  // namespace
}  // namespace medial_vk::platform
