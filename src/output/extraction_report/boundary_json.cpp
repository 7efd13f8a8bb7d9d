#include "output/extraction_report/boundary_json.h"

#include <algorithm>
#include <optional>
#include <string>

namespace medial_vk {
namespace {

using BoundaryJson = nlohmann::ordered_json;

BoundaryJson thickness_json(const std::optional<ThicknessRecord>& record) {
  if (!record) return nullptr;
  BoundaryJson least = nullptr;
  if (record->least) {
    least = {{"lower", record->least->lower}, {"upper", record->least->upper}, {"at", record->least_at}};
  }
  const double points = static_cast<double>(std::max<std::size_t>(record->intervals.size(), 1));
  BoundaryJson kinds = BoundaryJson::object();
  for (const ThicknessKind kind : kThicknessKinds) kinds[std::string(kind_name(kind))] = record->share(kind);
  return {{"delta", record->delta},
          {"width", record->width},
          {"points", record->intervals.size()},
          {"median", {{"lower", record->median.lower}, {"upper", record->median.upper}}},
          {"least_in_a_wall", least},
          {"kinds", kinds},
          {"wall_angle", record->wall_angle},
          {"crease_angle", record->crease_angle},
          {"wall_deltas", kWallDeltas},
          {"greatest", record->greatest},
          {"wide_interval", kWideInterval},
          {"wide_share", static_cast<double>(record->wide) / points}};
}

BoundaryJson curvature_json(const std::optional<CurvatureRecord>& record) {
  if (!record) return nullptr;
  const auto range = [](const std::optional<CurvatureRecord::Range>& of) -> BoundaryJson {
    if (!of) return nullptr;
    return {{"least", of->least}, {"greatest", of->greatest}};
  };
  BoundaryJson states = BoundaryJson::object();
  for (std::size_t i = 0; i < kCurvatureStates; ++i)
    states[std::string(state_name(static_cast<CurvatureState>(i)))] = record->state_shares[i];
  return {{"kappa_1", range(record->kappa_1)},
          {"kappa_2", range(record->kappa_2)},
          {"unknown_share", record->unknown_share},
          {"none_share", record->none_share},
          {"state_shares", states},
          {"median_error", record->median_error ? BoundaryJson(*record->median_error) : BoundaryJson(nullptr)}};
}

const char* name_of(WallRecord::Verdict verdict) {
  switch (verdict) {
    case WallRecord::Verdict::kThickEnough:
      return "thick enough";
    case WallRecord::Verdict::kTooThin:
      return "too thin";
    case WallRecord::Verdict::kMeasured:
      return "measured";
    case WallRecord::Verdict::kUndecided:
      break;
  }
  return "undecided";
}

BoundaryJson walls_json(const WallRecord& record) {
  BoundaryJson ball = nullptr;
  if (const std::optional<WallBall>& thinnest = record.found.thinnest) {
    ball = {{"centre", thinnest->ball.centre},
            {"radius", thinnest->ball.radius},
            {"contacts", {thinnest->a, thinnest->b}},
            {"object_angle", thinnest->object_angle}};
  }
  BoundaryJson places = BoundaryJson::array();
  for (const ThinPlace& place : record.places) {
    places.push_back(
        {{"lower", place.least.lower}, {"upper", place.least.upper}, {"at", place.at}, {"area", place.area}});
  }
  return {{"side", record.side == ThicknessSide::kWalls ? "walls" : "gaps"},
          {"demanded", record.demanded > 0 ? BoundaryJson(record.demanded) : BoundaryJson(nullptr)},
          {"object_angle", record.object_angle},
          {"verdict", name_of(record.verdict)},
          {"proved", record.found.diameter.lower},
          {"thinnest", ball},
          {"places", places},
          {"cells", record.found.cells}};
}

}  // namespace

nlohmann::ordered_json boundary_json(const BoundaryRecord& record) {
  if (!record.thickness && !record.curvature && record.walls.empty()) return nullptr;
  BoundaryJson walls = BoundaryJson::array();
  for (const WallRecord& of_side : record.walls) walls.push_back(walls_json(of_side));
  return {{"thickness", thickness_json(record.thickness)},
          {"curvature", curvature_json(record.curvature)},
          {"walls", walls}};
}

}  // namespace medial_vk
