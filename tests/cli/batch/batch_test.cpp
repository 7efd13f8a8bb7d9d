// `medial-vk batch` from outside: which meshes it finds, what it writes, and what it records of failures.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>

#include "cli/batch/batch_command.h"
#include "cli/paths.h"

namespace medial_vk {
namespace {

using test::ToolResult;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::Pair;

using BatchTest = test::BatchCommand;

TEST_F(BatchTest, WritesTheBytesOfARunForEachMesh) {
  for (const char* file : {"in/a.obj", "in/deep/b.obj"}) write_box(file, 0.5);
  write("in/c.stl", test::to_binary_stl(test::make_l_shape(2.0, 0.6, 0.8)));
  write("in/notes.md", "no mesh");
  const ToolResult result = run({"batch", "in", "-o", "out", "--resolution", "16", "--boundary", ".ply", "--picture",
                                 ".png", "--size", "64", "--medial-mesh", ".ma", "--volumes"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("3 done"));
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("c.stl", "done"), Pair("deep/b.obj", "done")));
  for (const std::string name : {"a.obj", "c.stl", "deep/b.obj"}) {
    const ToolResult single = run({"in/" + name, "-o", "s.ply", "--resolution", "16", "--boundary", "b.ply",
                                   "--picture", "p.png", "--size", "64", "--medial-mesh", "m.ma"});
    ASSERT_EQ(single.exit_code, 0) << single.err;
    EXPECT_EQ(bytes_of("out/" + name + ".medial.ply"), bytes_of("s.ply")) << name;
    EXPECT_EQ(bytes_of("out/" + name + ".boundary.ply"), bytes_of("b.ply")) << name;
    EXPECT_EQ(bytes_of("out/" + name + ".picture.png"), bytes_of("p.png")) << name;
    EXPECT_EQ(bytes_of("out/" + name + ".surface.ma"), bytes_of("m.ma")) << name;
  }
}

TEST_F(BatchTest, TheTableHasTheNumbersOfEachMesh) {
  write_box("in/a.obj", 0.5);
  const ToolResult result = batch({"in", "-o", "out", "--format", ".csv", "--volumes"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(bytes_of("out/batch.csv"),
              testing::StartsWith("name,state,error,file,triangles,closed,longest_side,volume,points,sheets,undecided,"
                                  "least_radius,greatest_radius,balls_volume,balls_area,least_wall_lower,"
                                  "least_wall_upper,least_gap_lower,least_gap_upper,thickness_lower,thickness_upper,"
                                  "seconds_read,seconds_prepare,seconds_search,seconds,device,files,content,options,"
                                  "version\na.obj,done,," +
                                  std::filesystem::canonical(path("in/a.obj")).string() + ",12,yes,1,"));
  const BatchRow row = rows().at(0);
  EXPECT_NEAR(std::stod(row[BatchColumn::kVolume]), 0.4, 1e-12);
  const std::string points = bytes_of("out/a.obj.medial.csv");
  EXPECT_EQ(std::stol(row[BatchColumn::kPoints]), std::count(points.begin(), points.end(), '\n') - 1);
  EXPECT_LE(std::stod(row[BatchColumn::kGreatestRadius]), 0.25);
  EXPECT_GT(std::stod(row[BatchColumn::kBallsVolume]), 0.1);
  EXPECT_LT(std::stod(row[BatchColumn::kBallsVolume]), 0.4);
  EXPECT_EQ(row[BatchColumn::kOptions], "--format .csv --volumes --resolution 6 --backend cpu");
}

TEST_F(BatchTest, FailuresAreRecordedByNameAndEndNothing) {
  write_box("in/a.obj", 0.5);
  write("in/b.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  write("in/c, \"c\".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::filesystem::create_symlink("nowhere", path("in/d.ply"));
  write_box("in/e.obj", 0.7);
  const ToolResult result = batch({"in", "-o", "out"});
  EXPECT_EQ(result.exit_code, 9);
  EXPECT_THAT(result.err, HasSubstr("3 of 5 meshes failed: out/batch.csv has the reasons"));
  EXPECT_THAT(result.err, testing::StartsWith("in/b.obj:4: "));
  EXPECT_THAT(result.err, HasSubstr("\nin/c, \"c\".obj: "));
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "done"), Pair("b.obj", "failed"), Pair("c, \"c\".obj", "failed"),
                                    Pair("d.ply", "failed"), Pair("e.obj", "done")));
  for (const BatchRow& row : rows()) EXPECT_EQ(row.is_done(), row[BatchColumn::kError].empty());
  EXPECT_THAT(rows().at(1)[BatchColumn::kError], HasSubstr("9"));
  EXPECT_TRUE(exists("out/e.obj.medial.ply"));
  EXPECT_FALSE(exists("out/b.obj.medial.ply"));
}

TEST_F(BatchTest, ALostDeviceIsOpenedAgain) {
  for (const char* file : {"in/a.obj", "in/b.obj", "in/c.obj"}) write_box(file, 0.5);
  write("faulty.json", R"({"file_format_version": "1.0.0", "ICD": {"library_path": ")" + test::faulty_driver_path() +
                           R"(", "api_version": "1.3.0"}})");
  test::ToolCall lost = call({"batch", "in", "-o", "out", "--resolution", "8"});
  lost.environment = {{"VK_DRIVER_FILES", path("faulty.json")},
                      {"VK_ICD_FILENAMES", path("faulty.json")},
                      {"FAULTY_DRIVER", "lose_first"}};
  const ToolResult result = run_tool(lost);
  EXPECT_EQ(result.exit_code, 9) << result.err;
  EXPECT_THAT(result.err, HasSubstr("was lost"));
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "failed"), Pair("b.obj", "done"), Pair("c.obj", "done")));
}

TEST_F(BatchTest, AFailedCheckIsAFailureWithFiles) {
  write("in/a.obj", test::to_obj(test::make_box({1, 1, 0.01})));
  write_box("in/b.obj", 0.5);
  const ToolResult result = batch({"in", "-o", "out", "--min-wall", "0.2"});
  EXPECT_EQ(result.exit_code, 9) << result.err;
  EXPECT_THAT(states(), ElementsAre(Pair("a.obj", "failed"), Pair("b.obj", "done")));
  EXPECT_TRUE(exists("out/a.obj.medial.ply"));
  EXPECT_FALSE(rows().at(0)[BatchColumn::kPoints].empty());
}

TEST_F(BatchTest, EqualNamesInDifferentFoldersHaveDifferentFiles) {
  write_box("one/part.obj", 0.5);
  write_box("two/part.obj", 0.7);
  write("two/part.off", test::to_off(test::make_box({1, 1, 1})));
  ASSERT_EQ(batch({"one", "two", "-o", "out"}).exit_code, 0);
  EXPECT_THAT(states(),
              ElementsAre(Pair("one/part.obj", "done"), Pair("two/part.obj", "done"), Pair("two/part.off", "done")));
  EXPECT_NE(bytes_of("out/one/part.obj.medial.ply"), bytes_of("out/two/part.obj.medial.ply"));
  // By absolute paths, and by paths that lead upwards: from the root.
  ASSERT_EQ(batch({path("one/part.obj"),
                   "one/../../" + std::filesystem::path(path("")).parent_path().filename().string() + "/two/part.obj",
                   "-o", "other"})
                .exit_code,
            0);
  const std::string root = std::filesystem::path(path("")).relative_path().string();
  EXPECT_THAT(states("other"), ElementsAre(Pair(root + "one/part.obj", "done"), Pair(root + "two/part.obj", "done")));
  // Two lists name different files alike.
  write("one/list.txt", "part.obj\n");
  write("two/list.txt", "part.obj\n");
  const ToolResult refused = batch({"one/list.txt", "two/list.txt", "-o", "third"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("would have one name, part.obj"));
  EXPECT_FALSE(exists("third"));
}

TEST_F(BatchTest, ListsHoldAPathInEachLine) {
  write_box("lists/in/a.obj", 0.5);
  write_box("lists/b c.obj", 0.6);
  write("lists/all.txt", "\xef\xbb\xbfin/a.obj\r\n\r\nb c.obj\nin/a.obj\nin/none.obj\n");
  EXPECT_EQ(batch({"lists/all.txt", "-o", "out"}).exit_code, 9);
  EXPECT_THAT(states(), ElementsAre(Pair("b c.obj", "done"), Pair("in/a.obj", "done"), Pair("in/none.obj", "failed")));
  // In the order of the list; from standard input, paths begin in the present folder.
  EXPECT_EQ(rows().at(0)[BatchColumn::kName], "in/a.obj");
  ASSERT_EQ(batch({"-", "-o", "piped"}, "lists/in/a.obj\nlists/b c.obj").exit_code, 0);
  EXPECT_THAT(states("piped"), ElementsAre(Pair("lists/b c.obj", "done"), Pair("lists/in/a.obj", "done")));
}

TEST_F(BatchTest, InputsWithoutMeshesAndUnreadableOnesEndTheRun) {
  std::filesystem::create_directory(path("empty"));
  write("none.txt", "\n\n");
  for (const char* input : {"empty", "none.txt", "missing.txt"}) {
    const ToolResult result = batch({input, "-o", "out"});
    EXPECT_EQ(result.exit_code, 3) << input << result.err;
    EXPECT_THAT(result.err, HasSubstr(input));
    EXPECT_FALSE(exists("out")) << input;
  }
  if (::geteuid() == 0) return;  // whom no permission stops
  write_box("closed/a.obj", 0.5);
  std::filesystem::permissions(path("closed"), std::filesystem::perms::none);
  EXPECT_EQ(batch({"closed", "-o", "out"}).exit_code, 3);
  std::filesystem::permissions(path("closed"), std::filesystem::perms::owner_all);
}

TEST_F(BatchTest, RefusesWhatItCannotDo) {
  write_box("in/a.obj", 0.5);
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused = {
      {{"in"}, "-o OUT is needed"},
      {{"-o", "out"}, "no FOLDER, LIST or mesh given"},
      {{"in", "-o", "-"}, "-o is a folder"},
      {{"-", "-", "-o", "out"}, "one list, not several"},
      {{"in", "-o", "out", "--format", "csv"}, "--format: 'csv' is no ending"},
      {{"in", "-o", "out", "--format", ".obj"}, "--format: "},
      {{"in", "-o", "out", "--report", "r/.json"}, "--report: 'r/.json' is no ending"},
      {{"in", "-o", "out", "--picture", "-"}, "--picture: '-' is no ending"},
      {{"in", "-o", "out", "--boundary", ".obj"}, "--boundary: 'MESH.boundary.obj' ends in none of"},
      {{"in", "-o", "out", "--size", "64"}, "--size is about the picture"},
      {{"in", "-o", "out", "--curvature"}, "--curvature has no column in the table: use it with --report .json"},
      {{"in", "-o", "out", "--kernel-times"}, "--kernel-times has no column in the table: use it with --report .json"},
      {{"", "-o", "out"}, "an input is empty"},
      {{"in", "", "-o", "out"}, "an input is empty"},
      {{"in", "-o", "out", "--each"}, "unknown option --each"},
      {{"in", "-o", "out", "--list-devices"}, "unknown option --list-devices"},
      {{"in", "-o", "out", "-q", "-v"}, "-q and -v"},
      {{"in", "-o", "in"}, "name another folder"},
      {{"in", "-o", "."}, "name another folder"},
  };
  for (const auto& [arguments, message] : refused) {
    const ToolResult result = batch(arguments);
    EXPECT_EQ(result.exit_code, 2) << message;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_THAT(result.err, HasSubstr("Try medial-vk batch --help."));
  }
  EXPECT_FALSE(exists("out"));
}

TEST_F(BatchTest, ResultsAreNoInputsAndReplaceNone) {
  write_box("in/a.obj", 0.5);
  ASSERT_EQ(batch({"in", "-o", "in/out", "--mesh-spheres"}).exit_code, 0);
  ASSERT_EQ(batch({"in", "-o", "in/out", "--mesh-spheres"}).exit_code, 0);
  EXPECT_THAT(states("in/out"), ElementsAre(Pair("a.obj", "done")));
  const std::string before = bytes_of("in/out/a.obj.spheres.ply");
  const ToolResult result = batch({"a.obj", "a.obj.spheres.ply", "-o", "."});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.err, HasSubstr("a.obj: No such file or directory"));
  write_box("a.obj", 0.5);
  write("a.obj.spheres.ply", before);
  const ToolResult refused = batch({"a.obj", "a.obj.spheres.ply", "-o", ".", "--mesh-spheres"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("would overwrite the mesh a.obj.spheres.ply"));
  EXPECT_EQ(bytes_of("a.obj.spheres.ply"), before);
}

TEST_F(BatchTest, LeavesForeignTablesAndFoldersInUseAlone) {
  write_box("in/a.obj", 0.5);
  write("out/batch.csv", "name,price\na,1\n");
  const ToolResult foreign = batch({"in", "-o", "out"});
  EXPECT_EQ(foreign.exit_code, 2);
  EXPECT_THAT(foreign.err, HasSubstr("out/batch.csv: line 1"));
  EXPECT_EQ(bytes_of("out/batch.csv"), "name,price\na,1\n");
  std::filesystem::remove(path("out/batch.csv"));
  const int lock = ::open(path("out/.medial-vk.lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(lock, LOCK_EX), 0);
  const ToolResult in_use = batch({"in", "-o", "out"});
  EXPECT_EQ(in_use.exit_code, 6);
  EXPECT_THAT(in_use.err, HasSubstr("another medial-vk batch is writing to out"));
  EXPECT_FALSE(exists("out/batch.csv"));
  ::close(lock);
  EXPECT_EQ(batch({"in", "-o", "out"}).exit_code, 0);
  write("file", "");
  EXPECT_EQ(batch({"in", "-o", "file/out"}).exit_code, 6);
}

TEST_F(BatchTest, ThePageShowsEveryMesh) {
  write_box("in/a.obj", 0.5);
  write_box("in/50% <b> \"&\".obj", 0.5);
  write("in/broken.obj", "f 1 2 3\n");
  EXPECT_EQ(batch({"in", "-o", "out", "--html"}).exit_code, 9);
  const std::string page = bytes_of("out/batch.html");
  EXPECT_THAT(page, HasSubstr("3 meshes, 1 failed"));
  EXPECT_THAT(page, HasSubstr("src=\"./a.obj.picture.png\""));
  EXPECT_THAT(page, HasSubstr("src=\"./50%25%20%3Cb%3E%20%22%26%22.obj.picture.png\""));
  EXPECT_THAT(page, HasSubstr("<h2>50% &lt;b> \"&amp;\".obj</h2>"));
  EXPECT_THAT(page, HasSubstr("<a href=\"./50%25%20%3Cb%3E%20%22%26%22.obj.medial.ply\">medial.ply</a>"));
  EXPECT_THAT(page, HasSubstr("<a href=\"./batch.csv\">batch.csv</a>"));
  EXPECT_THAT(page, HasSubstr("alt=\"50% &lt;b> &quot;&amp;&quot;.obj\""));
  EXPECT_THAT(page, Not(HasSubstr("broken.obj.picture")));
  EXPECT_THAT(page, HasSubstr("<dt>volume</dt><dd>0.4</dd>"));
  EXPECT_LT(page.find("broken.obj"), page.find("a.obj.picture"));  // failures come first
  EXPECT_TRUE(exists("out/a.obj.picture.png"));
  EXPECT_TRUE(exists("out/50% <b> \"&\".obj.picture.png"));
  // A later run has nothing to do but the page.
  std::filesystem::remove(path("out/batch.html"));
  const auto before = time_of("out/a.obj.picture.png");
  EXPECT_EQ(batch({"in", "-o", "out", "--html"}).exit_code, 9);
  EXPECT_EQ(bytes_of("out/batch.html"), page);
  EXPECT_EQ(time_of("out/a.obj.picture.png"), before);
}

TEST_F(BatchTest, ThePageShowsWhatWasMeasured) {
  write_box("in/a.obj", 0.5);
  const auto page_with = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"in", "-o", "out", "--html"});
    const ToolResult result = batch(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return bytes_of("out/batch.html");
  };
  const std::string plain = page_with({});
  EXPECT_THAT(plain, HasSubstr("<p>1 mesh, 0 failed."));
  EXPECT_THAT(plain, Not(HasSubstr("least wall")));
  EXPECT_THAT(plain, Not(HasSubstr("median thickness")));
  const std::string measured = page_with({"--least-wall", "--thickness", "--report", ".json"});
  EXPECT_THAT(measured, testing::ContainsRegex("<dt>least wall</dt><dd>0[.]49[0-9]* to 0[.]5</dd>"));
  EXPECT_THAT(measured, testing::ContainsRegex("<dt>median thickness</dt><dd>0[.][0-9]* to 0[.][0-9]*</dd>"));
  EXPECT_THAT(measured, HasSubstr("<a href=\"./a.obj.report.json\">report.json</a>"));
  EXPECT_THAT(page_with({"--min-wall", "0.1"}), HasSubstr("<dt>least wall, or demand</dt><dd>0."));
}

}  // namespace
}  // namespace medial_vk
