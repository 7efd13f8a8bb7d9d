#include <nlohmann/json.hpp>

#include "cli/spheres/spheres_record.h"
#include "output/charts/measures_output.h"
#include "output/version.h"

namespace medial_vk::cli {
namespace {

using Json = nlohmann::ordered_json;  // Keys stay in the order in which a reader wants them.

/// Number of the layout: raised when a key changes its meaning.
constexpr int kSpheresReportFormat = 1;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json goals_json(const SpheresOptions& options) {
  const auto given = [](auto value) { return value > 0 ? Json(value) : Json(nullptr); };
  return {{"count", given(options.request.count)},
          {"count_per_link", given(options.count_per_link)},
          {"total", given(options.total)},
          {"error", given(options.request.error)},
          {"max_gap", given(options.request.max_gap)},
          {"resolution", given(options.request.resolution)}};
}

Json part_json(const SpheresOptions& options, const SpheresRecord& record, std::size_t index) {
  const Part& part = record.parts[index];
  const PartFit& fit = record.fits[index];
  const bool is_checked = index < record.certificates.size() && record.certificates[index];
  const ReachOut& reach = fit.reach.back();
  Json counts = Json::array();
  for (const std::vector<Ball>& level : fit.levels) counts.push_back(level.size());
  return {{"link", part.link},
          {"geometry", part.name},
          {"triangles", part.mesh.report.triangles},
          {"closed", part.ball || part.mesh.report.closed},
          {"assumptions", part.mesh.report.assumptions},
          {"facet_share", part.facet_share},
          {"wanted", fit.wanted > 0 ? Json(fit.wanted) : Json(nullptr)},
          {"num_spheres", fit.levels.back().size()},
          {"levels", counts},
          {"solid_volume", or_null(fit.solid_volume)},
          {"volume_of", fit.of_shape ? "shape" : "mesh"},
          {"spheres_volume", or_null(fit.spheres_volume)},
          {"volume_error", or_null(uncovered_share(fit, options.request.contract))},
          {"measures", fit.measures ? measures_json(*fit.measures) : Json(nullptr)},
          {"check", is_checked ? Json(record.certificates[index]->passed() ? "passed" : "failed") : Json(nullptr)},
          {"reach_out", {{"mean", reach.mean}, {"best", reach.best}, {"worst", reach.worst}}},
          {"seconds", fit.seconds}};
}

}  // namespace

std::string spheres_report(const SpheresOptions& options, const SpheresRecord& record) {
  Json parts = Json::array();
  for (std::size_t i = 0; i < record.parts.size(); ++i) {
    parts.push_back(part_json(options, record, i));
  }
  Json seconds = Json::object();
  for (const StageTime& time : record.times) seconds[time.stage] = time.seconds;
  const Json json = {
      {"format", kSpheresReportFormat},
      {"program", "medial-vk spheres"},
      {"version", version()},
      {"input", options.input},
      {"output", options.output},
      {"output_format", name_of(options.format)},
      {options.is_robot ? "robot" : "mesh", record.robot},
      {"method", name_of(options.request.method)},
      {"contract", name_of(options.request.contract)},
      {"object_angle",
       options.request.method == SphereMethod::kSource ? Json(options.request.object_angle) : Json(nullptr)},
      {"backend", options.backend == Backend::kCpu ? "cpu" : "vulkan"},
      {"device", record.device ? Json(record.device->name) : Json(nullptr)},
      {"goals", goals_json(options)},
      {"num_spheres", count_spheres(record)},
      {"volume_error", or_null(uncovered_share(record, options.request.contract))},
      {"parts", parts},
      {"seconds", seconds}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk::cli
