#include "output/fit_reports/fits_report.h"

#include <nlohmann/json.hpp>

#include "medial_vk/version.h"
#include "output/charts_and_tables/measures_output.h"

namespace medial_vk {
namespace {

using Json = nlohmann::ordered_json;  // Keys keep their order, which is chosen for readers.

/// The number of the layout, raised when a key changes its meaning.
constexpr int kSpheresReportFormat = 1;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json goals_json(const FitsRecord& record) {
  const auto given = [](auto value) { return value > 0 ? Json(value) : Json(nullptr); };
  return {{"count", given(record.request.count)},
          {"count_per_link", given(record.count_per_link)},
          {"total", given(record.total)},
          {"error", given(record.request.error)},
          {"max_gap", given(record.request.max_gap)},
          {"resolution", given(record.request.resolution)}};
}

Json solid_json(const FitsRecord& record, std::size_t index) {
  const Part& solid = record.solids[index];
  const PartFit& fit = record.fits[index];
  const std::optional<CheckReport> check = record.checks.empty() ? std::nullopt : record.checks[index];
  const ReachOut& reach = fit.reach.back();
  Json counts = Json::array();
  for (const std::vector<Ball>& level : fit.levels) counts.push_back(level.size());
  return {{"link", solid.link},
          {"geometry", solid.name},
          {"triangles", solid.mesh.report.triangles},
          {"closed", solid.ball || solid.mesh.report.closed},
          {"assumptions", solid.mesh.report.assumptions},
          {"facet_share", record.facet_shares[index]},
          {"wanted", fit.wanted > 0 ? Json(fit.wanted) : Json(nullptr)},
          {"num_spheres", fit.levels.back().size()},
          {"levels", counts},
          {"solid_volume", or_null(fit.solid_volume)},
          {"volume_of", fit.of_shape ? "shape" : "mesh"},
          {"spheres_volume", or_null(fit.spheres_volume)},
          {"volume_error", or_null(uncovered_share(fit, record.request.contract))},
          {"measures", fit.measures ? measures_json(*fit.measures) : Json(nullptr)},
          {"check", check ? Json(check->passed() ? "passed" : "failed") : Json(nullptr)},
          {"reach_out", {{"mean", reach.mean}, {"best", reach.least}, {"worst", reach.greatest}}},
          {"seconds", fit.seconds}};
}

}  // namespace

std::string encode_fits_report(const FitsRecord& record) {
  Json solids = Json::array();
  for (std::size_t i = 0; i < record.solids.size(); ++i) {
    solids.push_back(solid_json(record, i));
  }
  Json seconds = Json::object();
  for (const StageTime& time : record.times) seconds[time.stage] = time.seconds;
  const Json json = {{"format", kSpheresReportFormat},
                     {"program", "medial-vk spheres"},
                     {"version", version()},
                     {"input", record.input},
                     {"output", record.output},
                     {"output_format", record.output_format},
                     {record.is_robot ? "robot" : "mesh", record.name},
                     {"method", name_of(record.request.method)},
                     {"contract", name_of(record.request.contract)},
                     {"object_angle", record.request.method == SphereMethod::kSource ? Json(record.request.object_angle)
                                                                                     : Json(nullptr)},
                     {"backend", record.backend == Backend::kCpu ? "cpu" : "vulkan"},
                     {"device", record.device ? Json(record.device->name) : Json(nullptr)},
                     {"goals", goals_json(record)},
                     {"num_spheres", count_spheres(record)},
                     {"volume_error", or_null(uncovered_share(record))},
                     {"parts", solids},
                     {"seconds", seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk
