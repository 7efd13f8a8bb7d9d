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
  return {{"count", given(record.spheres.count)},
          {"count_per_link", given(record.count_per_link)},
          {"total", given(record.total)},
          {"error", given(record.spheres.error)},
          {"max_gap", given(record.spheres.max_gap)},
          {"max_reach", given(record.spheres.max_reach)},
          {"max_distance", given(record.spheres.max_distance)},
          {"resolution", given(record.spheres.resolution)}};
}

/// Null for a share that is an estimate.
Json exact_json(const std::optional<Share>& share) {
  return share && !share->is_estimate ? Json(share->value) : Json(nullptr);
}

Json interval_json(const std::optional<Share>& share) {
  return share ? Json{share->lower(), share->upper()} : Json(nullptr);
}

Json advice_json(const std::optional<FitAdvice>& advice) {
  if (!advice) return nullptr;
  return {{"uncovered", advice->uncovered},
          {"inside_for_a_quarter", advice->inside > 0 ? Json(advice->inside) : Json(nullptr)},
          {"cover", {{"reach", advice->reach}, {"added", advice->added}}},
          {"by_distance", advice->by_distance}};
}

Json solid_json(const FittedSolid& solid, SphereContract of_record) {
  const SphereContract contract = solid.contract.value_or(of_record);
  const ReachOut& reach = solid.reach.back();
  const std::optional<Share> share = uncovered_share(solid, contract);
  Json counts = Json::array();
  for (const std::vector<Ball>& level : solid.levels) counts.push_back(level.size());
  return {{"link", solid.link},
          {"geometry", solid.name},
          {"contract", name_of(contract)},
          {"by", name_of(solid.aim)},
          {"triangles", solid.report().triangles},
          {"closed", solid.ball || solid.report().closed},
          {"assumptions", solid.report().assumptions},
          {"facet_share", solid.facet_share},
          {"wanted", solid.count > 0 ? Json(solid.count) : Json(nullptr)},
          {"num_spheres", solid.levels.back().size()},
          {"levels", counts},
          {"solid_volume", or_null(solid.solid_volume)},
          {"volume_of", solid.of_shape ? "shape" : "mesh"},
          {"spheres_volume", or_null(solid.spheres_volume)},
          {"volume_error", exact_json(share)},
          {"volume_error_interval", interval_json(share)},
          {"measures", solid.measures ? measures_json(*solid.measures) : Json(nullptr)},
          {"check", solid.check ? Json(solid.check->passed() ? "passed" : "failed") : Json(nullptr)},
          {"advice", advice_json(solid.advice)},
          {"reach_out", {{"mean", reach.mean}, {"best", reach.least}, {"worst", reach.greatest}}},
          {"seconds", solid.seconds}};
}

}  // namespace

std::string encode_fits_report(const FitsRecord& record) {
  Json solids = Json::array();
  for (const FittedSolid& solid : record.solids) solids.push_back(solid_json(solid, record.spheres.contract));
  Json seconds = Json::object();
  for (const StageTime& time : record.times) seconds[time.stage] = time.seconds;
  Json json = {{"format", kSpheresReportFormat},
               {"program", "medial-vk spheres"},
               {"version", version()},
               {"input", record.input},
               {"output", record.output},
               {"output_format", record.output_format},
               {record.is_robot ? "robot" : "mesh", record.name},
               {"method", name_of(record.spheres.method)},
               {"contract", record.is_body ? "both" : name_of(record.spheres.contract)},
               {"by", name_of(record.spheres.aim)},
               {"object_angle",
                record.spheres.method == SphereMethod::kSource ? Json(record.spheres.object_angle) : Json(nullptr)},
               {"backend", record.backend == Backend::kCpu ? "cpu" : "vulkan"},
               {"device", record.device ? Json(record.device->name) : Json(nullptr)},
               {"goals", goals_json(record)},
               {"num_spheres", count_spheres(record)},
               {"volume_error", exact_json(uncovered_share(record))},
               {"volume_error_interval", interval_json(uncovered_share(record))},
               {"parts", solids},
               {"seconds", seconds}};
  if (!record.part.empty()) json["part"] = record.part;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk
