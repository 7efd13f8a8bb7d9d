// The command line of `medial-vk doctor`: defaults, ranges, and helpful messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/help/help_texts.h"
#include "cli/options/doctor_options.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

DoctorOptions parsed_doctor(const std::vector<std::string>& arguments) {
  return value_of(parse_doctor_options(arguments), arguments);
}

std::string doctor_message(const std::vector<std::string>& arguments) {
  return message_of(parse_doctor_options(arguments), arguments);
}

TEST(DoctorOptions, Defaults) {
  const DoctorOptions options = parsed_doctor({});
  EXPECT_EQ(options, DoctorOptions());
  EXPECT_EQ(options.time_limit, 60u);
  EXPECT_FALSE(options.help);
}

TEST(DoctorOptions, AllAtOnce) {
  const DoctorOptions options = parsed_doctor({"--device", "radeon", "--report", "-", "--time-limit", "5", "-v"});
  EXPECT_EQ(options.device, "radeon");
  EXPECT_EQ(options.report, "-");
  EXPECT_EQ(options.time_limit, 5u);
  EXPECT_TRUE(options.verbose);
  EXPECT_TRUE(parsed_doctor({"--help"}).help);
  EXPECT_TRUE(parsed_doctor({"-q"}).quiet);
}

TEST(DoctorOptions, WrongOnesAreNamed) {
  EXPECT_THAT(doctor_message({"--devise", "0"}), HasSubstr("did you mean --device?"));
  EXPECT_THAT(doctor_message({"part.stl"}), HasSubstr("unexpected 'part.stl': doctor takes options only"));
  EXPECT_THAT(doctor_message({"--time-limit", "0"}), HasSubstr("--time-limit"));
  EXPECT_THAT(doctor_message({"--time-limit", "1e3"}), HasSubstr("--time-limit"));
  EXPECT_THAT(doctor_message({"--time-limit", "86401"}), HasSubstr("86400"));
  EXPECT_THAT(doctor_message({"-q", "-v"}), HasSubstr("-q and -v"));
  EXPECT_THAT(doctor_message({"--device"}), HasSubstr("--device"));
}

TEST(DoctorOptions, NoLineAffectsTheNext) {
  DoctorOptionParser parser;
  ASSERT_TRUE(parser.parse({"--device", "1", "-q"}).ok());
  ASSERT_FALSE(parser.parse({"--time-limit", "x"}).ok());
  EXPECT_EQ(parser.parse({}).value(), DoctorOptions());
}

TEST(DoctorOptions, HelpNamesEveryOption) {
  const std::string help = doctor_help_text();
  for (const char* option : {"--device", "--time-limit", "--report", "--quiet", "--verbose", "--help"})
    EXPECT_THAT(help, HasSubstr(option));
}

}  // namespace
}  // namespace medial_vk::cli
