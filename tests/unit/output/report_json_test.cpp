// The report: every documented key is there, with the right type.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/extract/summary.h"
#include "cli/terminal/tables.h"
#include "common/tool_errors.h"
#include "output/extraction_report/report_json.h"

namespace medial_vk {
namespace {

using nlohmann::json;
using testing::HasSubstr;

RunRecord some_record() {
  RunRecord record;
  record.input = "part.stl";
  record.output = "part.medial.ply";
  record.options.radius = 0.1;
  record.mesh.triangles = 12;
  record.mesh.closed = true;
  record.mesh.assumptions = {"Two holes were left open."};
  record.mesh.upper = {2, 1, 1};
  record.longest_side = 2;
  record.grid = {{0, 0, 0}, 0.0125, {160, 80, 80}};
  record.counters.levels = {{0.1, 1000, 200, 5000, 0}, {0.05, 1600, 300, 3000, 250}};
  record.counters.found = 250;
  record.counters.undecided = 3;
  record.certify = {249, 1};
  record.points = 249;
  record.radii = Range{0.01, 0.5};
  record.host_times = {{"read", 0.01}, {"extract", 2.0}};
  record.device_times = {{"dismiss cells", 1.5}};
  record.device = DeviceDescription{0, "Some GPU", "discrete", "driver 1.2", 0, 8ull << 30, true, {}, {}, {}, {}};
  return record;
}

TEST(ReportJson, HoldsEveryDocumentedKey) {
  const json report = json::parse(report_json(some_record()));
  for (const char* key :
       {"format", "program", "version",  "input",           "output",  "parameters", "mesh",        "grid",
        "voxels", "levels",  "queries",  "narrowing_steps", "retries", "points",     "per_point",   "sheets",
        "orders", "fatness", "grouping", "medial_mesh",     "seconds", "device",     "certificate", "boundary"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  for (const char* key : {"mode", "backend", "resolution", "object_angle", "radius", "epsilon", "extra_levels",
                          "simplify", "perturb", "seed", "memory_bytes"}) {
    EXPECT_TRUE(report["parameters"].contains(key)) << key;
  }
  for (const char* key : {"vertices",
                          "triangles",
                          "components",
                          "closed",
                          "degenerate_dropped",
                          "duplicates_dropped",
                          "open_edges",
                          "non_manifold_edges",
                          "inconsistent_edges",
                          "non_manifold_vertices",
                          "reoriented_faces",
                          "intersecting_faces",
                          "intersections_known",
                          "sides_known",
                          "signed_volume",
                          "lower",
                          "upper",
                          "longest_side",
                          "assumptions",
                          "merged_vertices",
                          "unused_vertices",
                          "fallback_polygons"}) {
    EXPECT_TRUE(report["mesh"].contains(key)) << key;
  }
  EXPECT_EQ(report["parameters"]["mode"], "certified");
  EXPECT_EQ(report["mesh"]["assumptions"][0], "Two holes were left open.");
  EXPECT_EQ(report["grid"]["size"], json::array({160, 80, 80}));
  EXPECT_EQ(report["voxels"]["found"], 250);
  EXPECT_EQ(report["voxels"]["rejected"], 1);
  EXPECT_EQ(report["levels"][1]["contacts"], 3000);
  EXPECT_EQ(report["points"]["radius"]["greatest"], 0.5);
  EXPECT_TRUE(report["points"]["object_angle"].is_null());
  EXPECT_EQ(report["seconds"]["host"][1]["stage"], "extract");
  EXPECT_EQ(report["seconds"]["device"][0]["seconds"], 1.5);
  EXPECT_EQ(report["device"]["name"], "Some GPU");
  EXPECT_TRUE(report["certificate"].is_null());
}

TEST(ReportJson, SaysWhatAPointCosts) {
  RunRecord record = some_record();
  EXPECT_EQ(json::parse(report_json(record))["per_point"]["lines"], 0);
  record.counters.levels[0].cluster_tests = 500;
  record.counters.levels[1].node_tests = 750;
  record.counters.levels[0].triangle_tests = 1000;
  record.counters.levels[1].triangle_tests = 24000;
  record.counters.levels[1].lines = 750;
  record.counters.narrowing_steps = 4;
  record.counters.queries = 125;
  const json cost = json::parse(report_json(record))["per_point"];
  EXPECT_EQ(cost["queries"], 0.5);
  EXPECT_EQ(cost["triangle_tests"], 100);
  EXPECT_EQ(cost["cluster_tests"], 2);
  EXPECT_EQ(cost["node_tests"], 3);
  EXPECT_EQ(cost["lines"], 3);
  EXPECT_EQ(cost["narrowing_steps"], 12);
  record.counters.found = 0;
  EXPECT_TRUE(json::parse(report_json(record))["per_point"].is_null());
}

TEST(ReportJson, Fatness) {
  RunRecord record = some_record();
  EXPECT_TRUE(json::parse(report_json(record))["fatness"].is_null());
  record.fatness = FatnessRecord{{{0.6, 20, 0.1, 0.06, 2, false}, {0.8, 0, 0, 0, 0, false}}, 0};
  json fatness = json::parse(report_json(record))["fatness"];
  ASSERT_EQ(fatness["angles"].size(), 2u);
  EXPECT_EQ(fatness["angles"][0]["object_angle"], 0.6);
  EXPECT_EQ(fatness["angles"][0]["points"], 20);
  EXPECT_EQ(fatness["angles"][0]["least_radius"], 0.1);
  EXPECT_EQ(fatness["angles"][0]["largest_voxel"], 0.06);
  EXPECT_EQ(fatness["angles"][0]["resolution"], 34);  // 2 / 0.06 = 33.3
  EXPECT_EQ(fatness["angles"][0]["components"], 2);
  EXPECT_EQ(fatness["angles"][0]["proves_connected"], false);
  EXPECT_TRUE(fatness["angles"][1]["resolution"].is_null());
  EXPECT_TRUE(fatness["proved"].is_null());
  EXPECT_THAT(cli::summary(record, {}), HasSubstr("voxels up to 0.06 at object angles from 0.6 rad\n"));
  record.fatness->of_angles[1] = {0.8, 10, 0.2, 0.12, 1, true};
  EXPECT_THAT(cli::summary(record, {}),
              HasSubstr("voxels up to 0.06 at object angles from 0.6 rad; voxels up to 0.12 at object angles from 0.8 "
                        "rad, whose balls are connected\n"));
  record.fatness->proved_radius = 0.05;
  fatness = json::parse(report_json(record))["fatness"];
  EXPECT_EQ(fatness["proved"]["object_angle"], record.options.object_angle);
  EXPECT_EQ(fatness["proved"]["least_radius"], 0.05);
  EXPECT_LE(fatness["proved"]["largest_voxel"].get<double>(), 0.05 / std::sqrt(3.0));
  EXPECT_NEAR(fatness["proved"]["largest_voxel"].get<double>(), 0.05 / std::sqrt(3.0), 1e-15);
}

TEST(ReportJson, SheetsAndMedialMesh) {
  RunRecord record = some_record();
  Sheet sheet;
  sheet.points = 200;
  sheet.area = 1.5;
  sheet.mean_radius = 0.2;
  sheet.mean_object_angle = 1.1;
  record.sheets.sheets = {sheet, sheet};
  record.sheets.sheets[1].significance = 0.25;
  record.sheets.fragments = 3;
  record.sheets.absorbed_points = 17;
  json report = json::parse(report_json(record));
  ASSERT_EQ(report["sheets"].size(), 2u);
  EXPECT_EQ(report["sheets"][1]["id"], 1);
  EXPECT_EQ(report["sheets"][0]["points"], 200);
  EXPECT_EQ(report["sheets"][0]["area"], 1.5);
  EXPECT_EQ(report["sheets"][0]["mean_radius"], 0.2);
  EXPECT_EQ(report["sheets"][0]["mean_object_angle"], 1.1);
  EXPECT_TRUE(report["sheets"][0]["significance"].is_null());
  EXPECT_TRUE(report["sheets"][0]["rank"].is_null());
  EXPECT_EQ(report["sheets"][1]["rank"], 1);
  EXPECT_EQ(report["sheets"][1]["significance"], 0.25);
  EXPECT_EQ(report["grouping"]["fragments"]["sheets"], 3);
  EXPECT_EQ(report["grouping"]["absorbed"]["points"], 17);
  EXPECT_EQ(report["grouping"]["sheet_angle"], 5.7);
  EXPECT_TRUE(report["medial_mesh"].is_null());

  record.medial_mesh = MedialTopology{{1, 2, 0}, -1, 20, 3, 4, 5};
  report = json::parse(report_json(record));
  EXPECT_EQ(report["medial_mesh"]["tunnels"], 2);
  EXPECT_EQ(report["medial_mesh"]["euler_characteristic"], -1);
  EXPECT_EQ(report["medial_mesh"]["hosted_points"], 5);
  EXPECT_TRUE(report["medial_mesh"]["solid"]["euler_characteristic"].is_null());
  record.euler_characteristic = 0;
  EXPECT_EQ(json::parse(report_json(record))["medial_mesh"]["solid"]["euler_characteristic"], 0);
  EXPECT_THAT(cli::summary(record, {}),
              HasSubstr("1 component, 2 tunnels, 0 cavities, Euler characteristic -1 (of the solid: 0)"));
}

TEST(ReportJson, UnionAndRemoval) {
  RunRecord record = some_record();
  json report = json::parse(report_json(record));
  EXPECT_TRUE(report["union"].is_null());
  EXPECT_TRUE(report["removal"].is_null());

  record.mesh.closed = true;
  record.mesh.signed_volume = 8;
  record.ball_union = UnionRecord{6, 12, {1, 2, 3}, 1};
  record.removal = SheetRemoval{{2, 0}, {0.75, 0.5}, {1, 3}};
  record.keep_volume = 0.5;
  report = json::parse(report_json(record));
  EXPECT_EQ(report["union"], json({{"volume", 6.0},
                                   {"area", 12.0},
                                   {"components", 1},
                                   {"leading_components", 1},
                                   {"tunnels", 2},
                                   {"cavities", 3}}));
  EXPECT_EQ(report["removal"]["removed"], json({2, 0}));
  EXPECT_EQ(report["removal"]["kept"], json({1, 3}));
  EXPECT_EQ(report["removal"]["volume_left"], json({0.75, 0.5}));
  EXPECT_EQ(report["removal"]["keep_topology"], false);
  EXPECT_TRUE(report["orders"].is_null());
  record.by_significance = SheetRemoval{{2, 0, 3}, {0.75, 0.5, 0.25}, {1}};
  record.orders_end_at = 0.2;
  report = json::parse(report_json(record));
  EXPECT_EQ(report["orders"]["least_volume"], 0.2);
  EXPECT_EQ(report["orders"]["significance"],
            json({{"kept", {1}}, {"removed", {2, 0, 3}}, {"volume_left", {0.75, 0.5, 0.25}}}));
  EXPECT_TRUE(report["orders"]["topology"].is_null());
  const std::string text = cli::summary(record, {});
  EXPECT_THAT(text, HasSubstr("6, 75.00 % of the solid; 1 component, 2 tunnels, 3 cavities"));
  EXPECT_THAT(text, HasSubstr("2 of 4 sheets, 50.00 % of the volume"));
}

TEST(ReportJson, CertificateAndCpu) {
  RunRecord record = some_record();
  record.backend = Backend::kCpu;
  record.device.reset();
  record.options.mode = Mode::kThesis;
  record.check.emplace();
  record.check->lines = {{"radius <= exact distance", 249, 1, 1e-9, "longest sides", "ball 17: too big"}};
  const json report = json::parse(report_json(record));
  EXPECT_TRUE(report["device"].is_null());
  EXPECT_EQ(report["parameters"]["backend"], "cpu");
  EXPECT_EQ(report["parameters"]["samples"], json::array({400, 200, 100, 50}));
  EXPECT_EQ(report["certificate"]["passed"], false);
  EXPECT_EQ(report["certificate"]["conditions"][0]["failed"], 1);
}

TEST(ReportJson, NamesThatAreNoUtf8AreNoError) {
  RunRecord record = some_record();
  record.input = "caf\xe9.obj";
  EXPECT_TRUE(json::accept(report_json(record)));
}

TEST(ReportTables, ColumnsAreAligned) {
  const std::string table = cli::format_table({{"name"}, {"count", true}}, {{"a", "1"}, {"longer", "1,000"}});
  EXPECT_EQ(table,
            "name    count\n"
            "a           1\n"
            "longer  1,000\n");
}

TEST(ReportTables, DevicesThatAreNoUseSayWhy) {
  DeviceDescription good, poor;
  good.name = "Some GPU";
  good.usable = true;
  good.memory_bytes = 8ull << 30;
  poor.index = 1;
  poor.name = "Old GPU";
  poor.why_not = {"its maxPerStageDescriptorStorageBuffers is 4, 16 are needed"};
  const std::string table = cli::device_table({good, poor});
  EXPECT_THAT(table, HasSubstr("8.0 GiB"));
  EXPECT_THAT(table, HasSubstr("yes\n"));
  EXPECT_THAT(table, HasSubstr("no: its maxPerStageDescriptorStorageBuffers is 4, 16 are needed\n"));
}

TEST(ReportTables, CertificateNamesTheFirstFailure) {
  CheckReport certificate;
  certificate.lines = {{"centre inside", 10, 0, 0, "", ""}, {"radius", 10, 2, 0.5, "voxels", "ball 3 at (1, 2, 3)"}};
  const std::string table = cli::check_table(certificate);
  EXPECT_THAT(table, HasSubstr("condition"));
  EXPECT_THAT(table, HasSubstr("0.5 voxels"));
  EXPECT_THAT(table, HasSubstr("first failure: ball 3 at (1, 2, 3)"));

  const Status verdict = cli::verdict(certificate);
  ASSERT_FALSE(verdict.ok());
  EXPECT_EQ(verdict.error().code, kCheckFailed);
  certificate.lines.pop_back();
  EXPECT_TRUE(cli::verdict(certificate).ok());
}

TEST(ReportSummary, SaysWhatMatters) {
  const RunRecord record = some_record();
  const OutputFile files[] = {{"part.medial.ply", std::string(17000, 0)}, {"a.png", "abc"}, {"-", "ab"}};
  const std::string text = cli::opening(record) + cli::summary(record, files);
  for (const char* part : {"part.stl", "12 triangles", "closed", "Two holes were left open.", "Some GPU", "249",
                           "250 found", "3 undecided", "0.01 to 0.5", "extract 2.00 s", "part.medial.ply (17.0 kB)",
                           "a.png (3 B)", "standard output (2 B)"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(cli::details(record), HasSubstr("dismiss cells"));
}

TEST(ReportJson, HoldsWhatWasMeasuredOnTheBoundary) {
  RunRecord record = some_record();
  EXPECT_TRUE(json::parse(report_json(record))["boundary"].is_null());
  ThicknessRecord thickness;
  thickness.delta = 0.001;
  thickness.intervals = {{1, 1.01}, {2, 3}, {2, 2.01}, {2, 2.01}};
  thickness.median = {2, 2.01};
  thickness.wide = 1;
  thickness.wall_angle = 1.3;
  thickness.of_kind = {0, 0, 1, 0, 3};
  record.boundary.thickness = thickness;
  json boundary = json::parse(report_json(record))["boundary"];
  EXPECT_TRUE(boundary["curvature"].is_null());
  EXPECT_TRUE(boundary["thickness"]["least_in_a_wall"].is_null());
  EXPECT_EQ(boundary["thickness"]["wide_share"], 0.25);
  EXPECT_EQ(boundary["thickness"]["points"], 4);
  EXPECT_EQ(boundary["thickness"]["kinds"]["wall"], 0.75);
  EXPECT_EQ(boundary["thickness"]["kinds"]["crease"], 0.25);
  EXPECT_EQ(boundary["thickness"]["kinds"].size(), 5u);
  EXPECT_EQ(boundary["thickness"]["wall_angle"], 1.3);
  record.boundary.thickness->least = Bounds{1, 1.01};
  record.boundary.thickness->least_at = {3, 4, 5};
  record.boundary.curvature = CurvatureRecord{{{-1.0, 2.0}}, {}, 0.125, 0.0625, 0.5};
  record.boundary.curvature->state_shares[static_cast<std::size_t>(CurvatureState::kUncertain)] = 0.0625;
  boundary = json::parse(report_json(record))["boundary"];
  EXPECT_EQ(boundary["thickness"]["least_in_a_wall"]["at"], (std::vector<double>{3, 4, 5}));
  EXPECT_EQ(boundary["curvature"]["kappa_1"]["greatest"], 2.0);
  EXPECT_TRUE(boundary["curvature"]["kappa_2"].is_null());
  EXPECT_EQ(boundary["curvature"]["unknown_share"], 0.125);
  EXPECT_EQ(boundary["curvature"]["none_share"], 0.0625);
  EXPECT_EQ(boundary["curvature"]["state_shares"]["uncertain"], 0.0625);
  EXPECT_EQ(boundary["curvature"]["state_shares"]["edge"], 0);
  const std::string text = cli::summary(record, {});
  EXPECT_THAT(text, HasSubstr("median 2 to 2.01 by area; least met in a wall 1 to 1.01 at 3, 4, 5"));
  EXPECT_THAT(text, HasSubstr("none at 6.25 % of the area (uncertain 6.25 %)"));
  EXPECT_THAT(text, HasSubstr("walls 75 %, creases 25 %, corners 0 %, facets 0 % of the area"));
  EXPECT_THAT(text, HasSubstr("wider than 10 % at 25 %"));
  EXPECT_THAT(
      text, HasSubstr("kappa 1 -1 to 2, kappa 2 unknown; one of both is known at 6.25 %, none at 6.25 % of the area"));
}

}  // namespace
}  // namespace medial_vk
