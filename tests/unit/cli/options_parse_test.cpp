// The command line as a struct: defaults, every option, ranges, and helpful messages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "cli/help/help_texts.h"
#include "cli/options/options.h"
#include "cli/options/parse_number.h"
#include "cli/terminal/numbers.h"
#include "cli/terminal/progress.h"
#include "unit/cli/parse_results.h"

namespace medial_vk::cli {
namespace {

using testing::HasSubstr;

/// For every command line of this file, also with a parser that has parsed the previous ones.
Result<Options> parse_twice(const std::vector<std::string>& arguments) {
  static OptionParser used;
  const Result<Options> options = parse_options(arguments), again = used.parse(arguments);
  EXPECT_EQ(options.ok(), again.ok()) << testing::PrintToString(arguments);
  if (options.ok() && again.ok()) {
    EXPECT_TRUE(options.value() == again.value()) << testing::PrintToString(arguments);
  }
  if (!options.ok() && !again.ok()) {
    EXPECT_EQ(options.error().message, again.error().message);
  }
  return options;
}

Options parsed(const std::vector<std::string>& arguments) { return value_of(parse_twice(arguments), arguments); }

std::string message_of(const std::vector<std::string>& arguments) {
  return message_of(parse_twice(arguments), arguments);
}

TEST(Options, DefaultsAreThoseOfTheContract) {
  const Options options = parsed({"models/bunny.obj"});
  EXPECT_EQ(options.action, Action::kExtract);
  EXPECT_EQ(options.mesh, "models/bunny.obj");
  EXPECT_EQ(options.output, "bunny.medial.ply");
  EXPECT_EQ(options.format, MedialFormat::kPly);
  EXPECT_EQ(options.extraction.mode, Mode::kCertified);
  EXPECT_EQ(options.extraction.resolution, 160u);
  EXPECT_EQ(options.extraction.object_angle, 0.6);
  EXPECT_EQ(options.extraction.radius, 0.0);
  EXPECT_EQ(options.extraction.epsilon, 0.01);
  EXPECT_EQ(options.extraction.extra_levels, 8u);
  EXPECT_EQ(options.backend, Backend::kVulkan);
  EXPECT_FALSE(options.ascii || options.simplify || options.check || options.quiet || options.verbose);
  EXPECT_TRUE(options.device.empty() && options.report.empty() && options.picture.empty() && options.html.empty());
}

TEST(Options, AParserForgetsEarlierLines) {
  OptionParser parser;
  const Options plain = parsed({"a.obj"});
  const std::vector<std::vector<std::string>> lines = {
      {"b.obj", "-q", "--ascii", "--check", "--resolution", "7", "--mode", "thesis", "-o", "b.csv", "--memory", "64"},
      {"--help"},
      {"b.obj", "--resolution", "8", "--resolution"},  // errors leave at different positions
      {"b.obj", "--resolution", "none", "--seed", "3"},
      {"b.obj", "--simplify", "--seed=3", "--no-such-option", "c.obj", "--", "-d"}};
  for (const std::vector<std::string>& line : lines) {
    (void)parser.parse(line);
    const Result<Options> options = parser.parse({"a.obj"});
    ASSERT_TRUE(options.ok()) << options.error().message << " after " << testing::PrintToString(line);
    EXPECT_TRUE(options.value() == plain) << testing::PrintToString(line);
  }
}

TEST(Options, ThePictureLooksAsRequested) {
  const auto look = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"a.obj", "--picture", "a.png"});
    return parsed(more).look;
  };
  EXPECT_TRUE(look({}) == PictureOptions());
  EXPECT_EQ(look({"--view", "front"}).view, (PictureView{{0, 0, 1}, UpAxis::kY}));
  EXPECT_EQ(look({"--view", "bottom"}).view, (PictureView{{0, -1, 0}, UpAxis::kY}));
  EXPECT_EQ(look({"--view", "-1,0.5,2e-1"}).view, (PictureView{{-1, 0.5, 0.2}, UpAxis::kY}));
  EXPECT_EQ(look({"--size", "640x480"}).size, (std::array<std::uint32_t, 2>{640, 480}));
  EXPECT_EQ(look({"--size=512"}).size, (std::array<std::uint32_t, 2>{512, 512}));
  EXPECT_EQ(look({"--show", "both"}).show, PictureShow::kBoth);
  EXPECT_EQ(look({"--colour", "radius"}).colour, PictureColour::kRadius);
}

/// Sides follow the up axis, numbers concern the mesh; the order of the two options does not matter.
TEST(Options, WhatIsUpDecidesWhereTheSidesAre) {
  const auto view = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"a.obj", "--picture", "a.png"});
    return parsed(more).look.view;
  };
  for (const char* axis : {"x", "y", "z", "-x", "-y", "-z"}) {
    const PictureView top = view({"--view", "top", "--up", axis});
    const std::string letters = axis;
    std::array<double, 3> expected = {0, 0, 0};
    expected[letters.back() - 'x'] = letters.size() == 1 ? 1 : -1;
    EXPECT_EQ(top.towards, expected) << axis;
    EXPECT_STREQ(axis_name(top.up), axis);
    EXPECT_EQ(view({"--up", axis, "--view", "3,1,2"}).towards, (std::array<double, 3>{3, 1, 2})) << axis;
  }
  EXPECT_EQ(view({"--up", "z", "--view", "front"}), (PictureView{{0, -1, 0}, UpAxis::kZ}));
  EXPECT_EQ(view({"--view", "right", "--up=z"}), (PictureView{{1, 0, 0}, UpAxis::kZ}));
  EXPECT_EQ(view({"--up", "z"}), (PictureView{{0.544, -0.762, 0.352}, UpAxis::kZ}));
  EXPECT_EQ(parsed({"a.obj", "--html", "a.html", "--up", "-z"}).look.view.up, UpAxis::kMinusZ);
}

TEST(Options, PicturesThatCannotBeAreUsageErrors) {
  const auto message = [](const char* option, const char* value) {
    return message_of({"a.obj", "--picture", "a.png", option, value});
  };
  for (const char* view : {"above", "", "1,2", "1,2,3,4", "0,0,0", "1,2,x", "nan,0,1", "1,,2", "1e300,0,0"}) {
    EXPECT_THAT(message("--view", view), HasSubstr("front, back, left, right, top, bottom, iso, or three numbers"));
  }
  for (const char* size : {"0", "15", "16385", "100x", "x100", "100x100x100", "1e3", "100 x 100", "-5"}) {
    EXPECT_THAT(message("--size", size), HasSubstr("use WIDTHxHEIGHT or one number for both, 16 to 16384"));
  }
  for (const char* up : {"", "w", "Z", "+z", "--z", "zz", "2"}) {
    EXPECT_THAT(message("--up", up), HasSubstr("use x, y, z, -x, -y or -z"));
  }
  EXPECT_THAT(message_of({"a.obj", "--up", "z"}), HasSubstr("--up is about picture and page: use it with --picture"));
  EXPECT_THAT(message("--show", "spheres"), HasSubstr("use points or balls or both"));
  EXPECT_THAT(message("--colour", "red"), HasSubstr("use angle or radius or sheet"));
  EXPECT_THAT(message_of({"a.obj", "--view", "top"}), HasSubstr("--view is about the picture"));
  EXPECT_THAT(message_of({"a.obj", "--show", "both"}), HasSubstr("use it with --picture FILE.png"));
}

TEST(Options, SheetsAreGroupedAsRequested) {
  EXPECT_TRUE(parsed({"a.obj"}).sheets == SheetOptions());
  const SheetOptions sheets = parsed({"a.obj", "--sheet-angle", "10", "--sheet-crease", "0", "--sheet-border", "60",
                                      "--sheet-width", "0.1", "--absorb-fragments", "20"})
                                  .sheets;
  EXPECT_EQ(sheets.angle, 10);
  EXPECT_EQ(sheets.crease, 0);
  EXPECT_EQ(sheets.border, 60);
  EXPECT_EQ(sheets.width, 0.1);
  EXPECT_EQ(sheets.absorb_fragments, 20u);
  EXPECT_THAT(message_of({"a.obj", "--sheet-angle", "91"}), HasSubstr("--sheet-angle"));
  EXPECT_THAT(message_of({"a.obj", "--sheet-crease", "-1"}), HasSubstr("--sheet-crease"));
  EXPECT_THAT(message_of({"a.obj", "--sheet-border", "181"}), HasSubstr("--sheet-border"));
  EXPECT_THAT(message_of({"a.obj", "--sheet-width", "2"}), HasSubstr("--sheet-width"));
  EXPECT_THAT(message_of({"a.obj", "--absorb-fragments", "many"}), HasSubstr("--absorb-fragments"));
}

TEST(Options, VolumesAreMeasuredAsRequested) {
  const Options options =
      parsed({"a.obj", "--keep-volume", "0.9", "--keep-topology", "--sheet-curve", "c.SVG", "--ball-volumes", "b.csv"});
  EXPECT_EQ(options.keep_volume, 0.9);
  EXPECT_TRUE(options.keep_topology);
  EXPECT_EQ(options.sheet_curve, "c.SVG");
  EXPECT_EQ(options.ball_volumes, "b.csv");
  EXPECT_THAT(message_of({"a.obj", "--keep-volume", "0"}), HasSubstr("--keep-volume"));
  EXPECT_THAT(message_of({"a.obj", "--keep-volume", "1.1"}), HasSubstr("--keep-volume"));
  EXPECT_THAT(message_of({"a.obj", "--keep-topology"}), HasSubstr("use it with --keep-volume"));
  EXPECT_THAT(message_of({"a.obj", "--sheet-curve", "c.png"}), HasSubstr("ends in neither .csv nor .svg"));
  EXPECT_THAT(message_of({"a.obj", "--ball-volumes", "b.txt"}), HasSubstr("does not end in .csv"));
}

TEST(Options, TheMedialMeshHasTwoFormats) {
  EXPECT_EQ(parsed({"a.obj", "--medial-mesh", "m.ma"}).medial_mesh, "m.ma");
  EXPECT_EQ(parsed({"a.obj", "--medial-mesh", "m.PLY"}).medial_mesh, "m.PLY");
  EXPECT_THAT(message_of({"a.obj", "--medial-mesh", "m.obj"}), HasSubstr("ends in neither .ply nor .ma"));
  EXPECT_THAT(message_of({"a.obj", "-o", "m.ply", "--medial-mesh", "m.ply"}), HasSubstr("are the same file"));
}

TEST(Options, EveryOptionIsUnderstood) {
  const Options options = parsed({"a.obj",
                                  "-o",
                                  "b.csv",
                                  "--ascii",
                                  "--report",
                                  "r.json",
                                  "--html",
                                  "p.html",
                                  "--picture",
                                  "p.png",
                                  "--resolution",
                                  "80",
                                  "--object-angle",
                                  "0.5",
                                  "--radius",
                                  "0.25",
                                  "--epsilon",
                                  "0.02",
                                  "--mode",
                                  "thesis",
                                  "--extra-levels",
                                  "2",
                                  "--simplify",
                                  "--keep-inner-faces",
                                  "--perturb",
                                  "1e-4",
                                  "--seed",
                                  "18446744073709551615",
                                  "--device",
                                  "llvm",
                                  "--memory",
                                  "2G",
                                  "--threads",
                                  "3",
                                  "--check",
                                  "--kernel-times",
                                  "-v"});
  EXPECT_EQ(options.output, "b.csv");
  EXPECT_EQ(options.format, MedialFormat::kCsv);
  EXPECT_TRUE(options.ascii && options.simplify && options.keep_inner_faces && options.check && options.verbose);
  EXPECT_TRUE(options.extraction.measurements.kernel_times);
  EXPECT_EQ(options.report, "r.json");
  EXPECT_EQ(options.picture, "p.png");
  EXPECT_EQ(options.html, "p.html");
  EXPECT_EQ(options.extraction.resolution, 80u);
  EXPECT_EQ(options.extraction.object_angle, 0.5);
  EXPECT_EQ(options.extraction.radius, 0.25);
  EXPECT_EQ(options.extraction.epsilon, 0.02);
  EXPECT_EQ(options.extraction.mode, Mode::kThesis);
  EXPECT_EQ(options.extraction.extra_levels, 2u);
  EXPECT_EQ(options.perturb, 1e-4);
  EXPECT_EQ(options.seed, 18446744073709551615ull);
  EXPECT_EQ(options.device, "llvm");
  EXPECT_EQ(options.extraction.memory_budget, 2ull << 30);
  EXPECT_EQ(options.threads, 3u);
}

TEST(Options, ShortAndJoinedForms) {
  EXPECT_EQ(parsed({"--output=b.ply", "a.obj"}).output, "b.ply");
  EXPECT_TRUE(parsed({"-q", "a.obj"}).quiet);
  EXPECT_EQ(parsed({"--backend", "cpu", "a.obj"}).backend, Backend::kCpu);
  EXPECT_EQ(parsed({"--", "-odd-name.obj"}).mesh, "-odd-name.obj");
}

TEST(Options, StandardStreams) {
  EXPECT_EQ(parsed({"-"}).output, "stdin.medial.ply");
  const Options options = parsed({"-", "-o", "-"});
  EXPECT_EQ(options.output, "-");
  EXPECT_EQ(options.format, MedialFormat::kPly);
  EXPECT_THAT(message_of({"a.obj", "-o", "-", "--report", "-"}), HasSubstr("--output and --report are the same"));
}

TEST(Options, ActionsNeedNoMesh) {
  EXPECT_EQ(parsed({"--help"}).action, Action::kHelp);
  EXPECT_EQ(parsed({"-h"}).action, Action::kHelp);
  EXPECT_EQ(parsed({"--version"}).action, Action::kVersion);
  EXPECT_EQ(parsed({"--list-devices"}).action, Action::kListDevices);
}

TEST(Options, MissingAndSuperfluousArguments) {
  EXPECT_THAT(message_of({}), HasSubstr("no MESH"));
  EXPECT_THAT(message_of({"a.obj", "b.obj"}), HasSubstr("'b.obj'"));
  EXPECT_THAT(message_of({"a.obj", "--resolution"}), HasSubstr("--resolution"));
  EXPECT_THAT(message_of({"a.obj", "--seed", "1", "--seed", "2"}), HasSubstr("--seed"));
}

TEST(Options, UnknownOptionsGetASuggestion) {
  EXPECT_THAT(message_of({"a.obj", "--resoltion", "80"}), HasSubstr("did you mean --resolution?"));
  EXPECT_THAT(message_of({"a.obj", "--resoltion=80"}), HasSubstr("did you mean --resolution?"));
  EXPECT_THAT(message_of({"--bogus-beyond-recognition", "a.obj"}),
              HasSubstr("unknown option --bogus-beyond-recognition"));
  EXPECT_THAT(message_of({"a.obj", "-z"}), HasSubstr("unknown option -z"));
}

struct BadValue {
  const char* option;
  const char* value;
};

class OptionsOutOfRange : public testing::TestWithParam<BadValue> {};

TEST_P(OptionsOutOfRange, IsRefusedWithTheNameAndTheValue) {
  const auto& [option, value] = GetParam();
  const std::string message = message_of({"a.obj", option, value});
  EXPECT_THAT(message, HasSubstr(option));
  EXPECT_THAT(message, HasSubstr(value));
}

INSTANTIATE_TEST_SUITE_P(
    , OptionsOutOfRange,
    testing::Values(BadValue{"--resolution", "0"}, BadValue{"--resolution", "4097"}, BadValue{"--resolution", "-5"},
                    BadValue{"--resolution", "1e3"}, BadValue{"--resolution", "80x"}, BadValue{"--resolution", "80.5"},
                    BadValue{"--resolution", "99999999999999999999"}, BadValue{"--object-angle", "0"},
                    BadValue{"--object-angle", "1.5708"}, BadValue{"--object-angle", "nan"},
                    BadValue{"--object-angle", "abc"}, BadValue{"--radius", "-0.1"}, BadValue{"--radius", "1.01"},
                    BadValue{"--epsilon", "0.0009"}, BadValue{"--epsilon", "0.51"}, BadValue{"--epsilon", "inf"},
                    BadValue{"--mode", "fast"}, BadValue{"--backend", "cuda"}, BadValue{"--extra-levels", "11"},
                    BadValue{"--perturb", "0.2"}, BadValue{"--seed", "-1"}, BadValue{"--seed", "18446744073709551616"},
                    BadValue{"--memory", "63"}, BadValue{"--memory", "many"}, BadValue{"--memory", "2X"},
                    BadValue{"--threads", "-1"}, BadValue{"--picture", "p.jpg"}, BadValue{"--html", "p.png"},
                    BadValue{"--output", "b.stl"}, BadValue{"--output", "noextension"}));

TEST(Options, MessagesNameTheRange) {
  EXPECT_EQ(message_of({"a.obj", "--resolution", "5000"}), "--resolution: 5000 is not between 1 and 4096 voxels");
  EXPECT_EQ(message_of({"a.obj", "--mode", "fast"}), "--mode: 'fast' is unknown; use certified or thesis");
  EXPECT_THAT(message_of({"a.obj", "-o", "b.stl"}), HasSubstr("use .ply, .csv, .npz, .json or .glb"));
}

TEST(Options, ContradictionsAreRefused) {
  message_of({"a.obj", "-q", "-v"});
  message_of({"a.obj", "--backend", "cpu", "--device", "0"});
  EXPECT_THAT(message_of({"a.ply", "-o", "./a.ply"}), HasSubstr("would overwrite the input"));
  EXPECT_THAT(message_of({"a.obj", "-o", "b.ply", "--report", "./b.ply"}), HasSubstr("same file"));
  EXPECT_THAT(message_of({"a.obj", "--html", "-", "--report", "-"}), HasSubstr("same file"));
}

TEST(Options, BallsOfTrianglesHaveTheirOwnNameAndDetail) {
  const Options balls = parsed({"models/a.obj", "--mesh-spheres", "--sphere-detail", "0"});
  EXPECT_EQ(balls.output, "a.spheres.ply");
  EXPECT_TRUE(balls.mesh_spheres);
  EXPECT_EQ(balls.sphere_detail, 0u);
  EXPECT_FALSE(parsed({"a.obj", "-o", "-", "--mesh-spheres"}).sphere_detail.has_value());
  const Options glb = parsed({"a.obj", "-o", "a.GLB", "--gpu-instancing", "--sphere-detail", "5"});
  EXPECT_EQ(glb.format, MedialFormat::kGlb);
  EXPECT_TRUE(glb.gpu_instancing);
}

TEST(Options, BallsAreForFormatsThatHaveThem) {
  for (const char* file : {"b.csv", "b.npz", "b.json"}) {
    EXPECT_THAT(message_of({"a.obj", "-o", file, "--mesh-spheres"}), HasSubstr("use it with .ply or .glb"));
  }
  for (const char* file : {"b.ply", "b.npz", "-"}) {
    EXPECT_THAT(message_of({"a.obj", "-o", file, "--gpu-instancing"}), HasSubstr("is for .glb"));
    EXPECT_THAT(message_of({"a.obj", "-o", file, "--sphere-detail", "1"}), HasSubstr("--mesh-spheres"));
  }
  message_of({"a.obj", "-o", "b.glb", "--gpu-instancing", "--mesh-spheres"});
  EXPECT_THAT(message_of({"a.obj", "-o", "b.glb", "--sphere-detail", "6"}), HasSubstr("not between 0 and 5"));
}

TEST(Options, TheMeshIsNotOverwrittenThroughALink) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "options_link";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.ply") << "ply\n";
  std::error_code error;
  std::filesystem::remove(folder / "link.ply", error);
  std::filesystem::create_symlink("a.ply", folder / "link.ply", error);
  if (error == std::errc::function_not_supported) GTEST_SKIP() << "no symbolic links on this system";
  ASSERT_FALSE(error) << error.message();
  EXPECT_THAT(message_of({(folder / "a.ply").string(), "-o", (folder / "link.ply").string()}),
              HasSubstr("would overwrite"));
}

TEST(Options, HelpNamesEveryOptionAndFitsATerminal) {
  const std::string help = help_text();
  std::istringstream names(
      "MESH --each --output --ascii --report --picture --html --resolution --object-angle --radius --epsilon --mode "
      "--extra-levels --simplify --keep-inner-faces --perturb --seed --list-devices --device --backend --memory "
      "--threads --check --kernel-times --quiet --verbose --version --help 130");
  for (std::string name; names >> name;) {
    EXPECT_THAT(help, HasSubstr(name));
  }
  std::size_t begin = 0;
  for (std::size_t end = help.find('\n'); end != std::string::npos; end = help.find('\n', begin)) {
    EXPECT_LE(end - begin, 80u) << help.substr(begin, end - begin);
    begin = end + 1;
  }
}

TEST(Options, MemorySuffixes) {
  EXPECT_EQ(parse_memory("512").value(), 512ull << 20);
  EXPECT_EQ(parse_memory("512MiB").value(), 512ull << 20);
  EXPECT_EQ(parse_memory("512mb").value(), 512ull << 20);
  EXPECT_EQ(parse_memory("1.5G").value(), 1536ull << 20);
  EXPECT_EQ(parse_memory("1T").value(), 1ull << 40);
  EXPECT_EQ(parse_memory("131072K").value(), 128ull << 20);
  EXPECT_FALSE(parse_memory("").ok());
  EXPECT_FALSE(parse_memory("G").ok());
  EXPECT_FALSE(parse_memory("1.2.3G").ok());
}

TEST(OptionsText, NumbersForPeople) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(duration(0.123), "0.12 s");
  EXPECT_EQ(duration(12.3), "12 s");
  EXPECT_EQ(duration(59.7), "1 min 00 s");
  EXPECT_EQ(duration(185), "3 min 05 s");
  EXPECT_EQ(duration(7800), "2 h 10 min");
  EXPECT_EQ(microseconds(1.234e-7), "0.123");
  EXPECT_EQ(microseconds(0.0009996), "1,000");
  EXPECT_EQ(microseconds(0.0123456), "12,346");
  EXPECT_EQ(byte_size(812), "812 B");
  EXPECT_EQ(byte_size(1234567), "1.2 MB");
  EXPECT_EQ(memory_size(512ull << 20), "512 MiB");
  EXPECT_EQ(memory_size(3ull << 29), "1.5 GiB");
}

TEST(OptionsText, ProgressLine) {
  EXPECT_THAT(progress_line("extract", 0.5, 10), HasSubstr("50 %, 10 s left"));
  EXPECT_THAT(progress_line("extract", 0.0, 10), HasSubstr("  0 %"));
  EXPECT_EQ(count_line("programs", 12, 29), "programs   [============                  ] 12 of 29");
  EXPECT_EQ(count_line("programs", 0, 0), "programs   [==============================] 0 of 0");
  EXPECT_THAT(progress_line("extract", 2.0, 10), HasSubstr("100 %"));  // A share above 1 does not draw past the end.
}

}  // namespace
}  // namespace medial_vk::cli
