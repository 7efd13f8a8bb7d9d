// The page as bytes: base64, harmless names, the same bytes twice. Its display in a browser: tests/page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "output/page/base64.h"
#include "output/page/page.h"

namespace medial_vk {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string base64(const std::string& text) {
  std::string out;
  page::append_base64(out, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  return out;
}

TEST(Page, Base64OfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd\xfb"), "//79+w==");
}

/// One triangle far away, with one ball.
class PageBytes : public testing::Test {
 protected:
  PageBytes() {
    if (!check_page_available()) return;
    mesh_.vertices = {{1e6, 0, 0}, {1e6 + 1, 0, 0}, {1e6, 1, 0}};
    mesh_.triangles = {{0, 1, 2}};
    MedialSphere sphere = {{1e6 + 0.5, 0.25, 0}, 0.125, {1, 0, 0}, {0, 1, 0}, 0.75f, 0.5f, -1, {3, 2, 1}};
    spheres_ = {sphere};
    record_.input = "part.stl";
    record_.mesh.lower = {1e6, 0, 0};
    record_.mesh.upper = {1e6 + 1, 1, 0};
    record_.longest_side = 1;
    record_.grid = {{1e6, 0, 0}, 0.125, {8, 8, 1}};
    record_.points = 1;
  }

  void SetUp() override {
    if (!check_page_available()) GTEST_SKIP() << check_page_available().error().message;
  }

  std::string page() const { return encode_page(mesh_, spheres_, record_); }

  Mesh mesh_;
  std::vector<MedialSphere> spheres_;
  RunRecord record_;
};

TEST_F(PageBytes, HoldsTheNumbersAroundTheMiddleOfTheMesh) {
  const std::string text = page();
  // -0.5 -0.5 0 and so on: no digit is lost far away.
  const float vertices[] = {-0.5f, -0.5f, 0, 0.5f, -0.5f, 0, -0.5f, 0.5f, 0};
  const std::string expected = base64({reinterpret_cast<const char*>(vertices), sizeof(vertices)});
  EXPECT_THAT(text, HasSubstr("<script type=\"text/plain\" id=\"data-vertices\">" + expected + "</script>"));
  EXPECT_THAT(text, HasSubstr("id=\"data-voxels\">" + base64(std::string("\3\0\2\0\1\0", 6)) + "</script>"));
  EXPECT_THAT(text, HasSubstr("\"origin\":[1000000.5,0.5,0.0],\"scale\":1.0"));
  EXPECT_THAT(text, HasSubstr("<title>part.stl - "));
  EXPECT_THAT(text, Not(HasSubstr("<!--medial-vk")));
}

TEST_F(PageBytes, SaysWhatIsUp) {
  EXPECT_THAT(page(), HasSubstr("\"up\":\"y\""));
  EXPECT_THAT(encode_page(mesh_, spheres_, record_, UpAxis::kMinusZ), HasSubstr("\"up\":\"-z\""));
}

TEST_F(PageBytes, TimesDoNotChangeIt) {
  const std::string first = page();
  record_.host_times = {{"extract", 0.123}};
  record_.device_times = {{"dismiss", 0.456}};
  EXPECT_EQ(page(), first);
}

TEST_F(PageBytes, ANameCannotBreakOut) {
  record_.input = "a</script><script>alert(1)</script><!--.obj";
  record_.output = "b</title>&\xff.ply";
  const std::string text = page();
  EXPECT_THAT(text, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(text, HasSubstr("<title>script>&lt;!--.obj"));  // the part after the last slash
  EXPECT_THAT(text, Not(HasSubstr("b</title>")));
  EXPECT_THAT(text, Not(HasSubstr("\xff")));
}

TEST_F(PageBytes, NeedsNoNetworkAndCarriesTheLicence) {
  const std::string text = page();
  EXPECT_THAT(text, HasSubstr("default-src 'none'"));
  EXPECT_THAT(text, HasSubstr("three.js authors"));
  EXPECT_THAT(text, HasSubstr("Permission is hereby granted"));
  for (const char* request : {" src=", "<link", "@import", "url("}) EXPECT_THAT(text, Not(HasSubstr(request)));
}

TEST_F(PageBytes, NothingFoundIsAPageToo) {
  spheres_.clear();
  record_.points = 0;
  EXPECT_THAT(page(), HasSubstr("id=\"data-centres\"></script>"));
}

}  // namespace
}  // namespace medial_vk
