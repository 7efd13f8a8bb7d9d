#include "cli/extract/wall_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "base/stopwatch.h"
#include "boundary_fields/summaries.h"
#include "cli/terminal/tables.h"
#include "common/tool_errors.h"
#include "medial_vk/thickness.h"
#include "sphere_fits/quality/surface_samples.h"

namespace medial_vk::cli {
namespace {

constexpr std::size_t kPointsForPlaces = 10'000, kMostPlaces = 20;

// Of what is demanded. Points of the boundary this close to a ball of a hundred times the radius count as contacts: in
// directions from its centre, they are within acos(100 / 101) = 0.14 radians of where a plane may touch it.
constexpr double kDeltaShare = 0.005;

// Of what is demanded: the search ends when this share is left, and smaller walls are looked for below the same share.
// Both together are less than kThinShare.
constexpr double kHalfShare = 0.49 * kThinShare;

// Most points are far thicker or thinner than demanded, which a wide interval shows. With the fine one, a wall that is
// too thin has an upper end below what is demanded.
constexpr double kCoarseWidth = 0.1, kFineWidth = kThinShare;

// Distances for a point. Where walls are much thinner than demanded, delta is so large a part of them that a narrow
// interval would take hundreds (thickness.h), and what is demanded is far above a wide one.
constexpr std::uint32_t kFewQueries = 100;
static_assert((1 - kThinShare) * (1 + kFineWidth) < 1);

// Of the longest side. Wider gaps are not searched for: outside there is always more space, and most of the time would
// go to balls as large as the solid.
constexpr double kGreatestGap = 0.25;

const char* name_of(const WallRecord& record) { return record.side == ThicknessSide::kWalls ? "wall" : "gap"; }

/// Finds places that are too thin.
class PlaceSearch {
 public:
  PlaceSearch(const IndexedMesh& mesh, const WallRecord& record, const Options& options, ProgressCallback on_progress)
      : mesh_(mesh), record_(record), on_progress_(std::move(on_progress)) {
    how_.side = record.side;
    how_.delta = std::min(options.thickness_delta * mesh.longest_side(), kDeltaShare * record.demanded);
    how_.limit = 2 * record.demanded;
    how_.threads = options.threads;
    how_.patience = how_.queries;
  }

  /// Where points of equal areas are proved to be too thin, and the place of the thinnest ball if none of them is.
  Result<std::vector<ThinPlace>> run() {
    const std::vector<Point> points = sample_surface(mesh_.prepared().mesh, kPointsForPlaces);
    how_.width = kCoarseWidth;
    how_.queries = kFewQueries;
    Result<std::vector<Thickness>> at_points = measure_thickness(mesh_, points, how_, on_progress_);
    if (!at_points) return at_points.error();
    how_.width = kFineWidth;
    if (Status status = decide(points, at_points.value()); !status) return status.error();
    const double share = area_of(mesh_.prepared().mesh) / static_cast<double>(std::max<std::size_t>(points.size(), 1));
    const Bounds& least = record_.found.diameter;
    std::vector<ThinPlace> places =
        group_thin_places(points, at_points.value(), share, {least.lower, record_.demanded}, record_.object_angle);
    how_.queries = ThicknessOptions().queries;
    if (Status status = refine(places); !status) return status.error();
    std::erase_if(places, [&](const ThinPlace& p) { return p.least.upper < least.lower; });  // in no wall, as it proves
    const bool is_known = std::ranges::any_of(places, [&](const ThinPlace& p) { return p.least.lower <= least.upper; });
    if (!is_known) places.insert(places.begin(), ThinPlace{least, record_.found.thinnest->a, 0});
    return places;
  }

 private:
  /// Narrows the intervals that do not tell whether a point is too thin, and searches on for the ball where it is none
  /// in a wall.
  Status decide(std::span<const Point> points, std::span<Thickness> at_points) const {
    std::vector<Point> open;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Bounds& diameter = at_points[i].diameter;
      const bool is_thick = diameter.lower >= record_.demanded * (1 - kThinShare);
      // Of a point whose interval begins below all walls the fine one tells whether it is in one.
      const bool is_in_wall =
          diameter.lower >= record_.found.diameter.lower && at_points[i].object_angle >= record_.object_angle;
      if (is_thick || (diameter.upper < record_.demanded && is_in_wall)) continue;
      open.push_back(points[i]);
      numbers.push_back(i);
    }
    Result<std::vector<Thickness>> found = measure_thickness(mesh_, open, how_, on_progress_);
    if (!found) return found.error();
    for (std::size_t i = 0; i < numbers.size(); ++i) at_points[numbers[i]] = found.value()[i];
    return {};
  }

  /// Narrows the intervals that are shown, and those that may hold the thinnest ball.
  Status refine(std::span<ThinPlace> places) const {
    std::vector<Point> at;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i >= kMostPlaces && places[i].least.lower > record_.found.diameter.upper) continue;
      at.push_back(places[i].at);
      numbers.push_back(i);
    }
    Result<std::vector<Thickness>> found = measure_thickness(mesh_, at, how_, on_progress_);
    if (!found) return found.error();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      Bounds& least = places[numbers[i]].least;  // both intervals hold the thickness
      least = {std::max(least.lower, found.value()[i].diameter.lower),
               std::min(least.upper, found.value()[i].diameter.upper)};
    }
    return {};
  }

  const IndexedMesh& mesh_;
  const WallRecord& record_;
  const ProgressCallback on_progress_;
  ThicknessOptions how_;
};

Result<LeastWall> search(const IndexedMesh& mesh, const WallRecord& record, double limit, double width,
                         const Options& options, const ProgressCallback& shown) {
  LeastWallOptions how;
  how.side = record.side;
  how.object_angle = record.object_angle;
  how.limit = limit;
  how.width = width;
  how.threads = options.threads;
  return measure_least_wall(mesh, how, shown);
}

Result<WallRecord> measure(const IndexedMesh& mesh, ThicknessSide side, const Options& options, Progress& progress) {
  WallRecord record = {.side = side, .object_angle = options.wall_angle, .verdict = WallRecord::Verdict::kMeasured};
  const auto shown = [&](double done) { progress.update(name_of(record), done); };
  const double limit = side == ThicknessSide::kGaps ? kGreatestGap * mesh.longest_side() : 0;
  Result<LeastWall> found = search(mesh, record, limit, kThinShare, options, shown);
  if (!found) return found.error();
  record.found = std::move(found).value();
  return record;
}

Result<WallRecord> compare(const IndexedMesh& mesh, ThicknessSide side, double demanded, const Options& options,
                           Progress& progress) {
  WallRecord record = {.side = side, .demanded = demanded, .object_angle = options.wall_angle};
  const auto shown = [&](double done) { progress.update(name_of(record), done); };
  Result<LeastWall> found = search(mesh, record, demanded * (1 - kHalfShare), kHalfShare, options, shown);
  if (!found) return found.error();
  record.found = std::move(found).value();
  if (record.found.thinnest) {
    record.verdict = WallRecord::Verdict::kTooThin;
    Result<std::vector<ThinPlace>> places = PlaceSearch(mesh, record, options, shown).run();
    if (!places) return places.error();
    record.places = std::move(places).value();
  } else if (record.found.diameter.lower < demanded * (1 - kThinShare)) {
    record.verdict = WallRecord::Verdict::kUndecided;
  }
  return record;
}

}  // namespace

Result<std::vector<WallRecord>> measure_walls(const IndexedMesh& mesh, const Options& options, Progress& progress,
                                              std::vector<StageTime>& times) {
  std::vector<WallRecord> records;
  Stopwatch stopwatch;
  struct Side {
    ThicknessSide side;
    bool is_measured;
    double demanded;
  };
  for (const auto& [side, is_measured, demanded] : {Side{ThicknessSide::kWalls, options.least_wall, options.min_wall},
                                                    Side{ThicknessSide::kGaps, options.least_gap, options.min_gap}}) {
    if (is_measured) {
      Result<WallRecord> record = measure(mesh, side, options, progress);
      if (!record) return record.error();
      records.push_back(std::move(record).value());
    }
    if (demanded > 0) {
      Result<WallRecord> record = compare(mesh, side, demanded, options, progress);
      if (!record) return record.error();
      records.push_back(std::move(record).value());
    }
  }
  if (!records.empty()) times.push_back({"walls", stopwatch.lap()});
  return records;
}

std::string describe_walls(const WallRecord& record) {
  const Bounds& least = record.found.diameter;
  if (!record.found.thinnest && record.verdict == WallRecord::Verdict::kMeasured) {
    return fmt::format(
        "none was found that is thinner than {:.6g}; that no {} is thinner than {:.6g} is proved for object "
        "angles of {:g} and more",
        least.upper, name_of(record), least.lower, record.object_angle);
  }
  const std::string wanted = fmt::format("{:.6g}", record.demanded);
  if (record.verdict == WallRecord::Verdict::kThickEnough) {
    return fmt::format(
        "no {} is thinner than {:.4g}, which is {} to a hundredth: proved for object angles of {:g} and more",
        name_of(record), least.lower, wanted, record.object_angle);
  }
  if (record.verdict == WallRecord::Verdict::kUndecided) {
    return fmt::format("no {} thinner than {} was found, but only {:.6g} is proved", name_of(record), wanted,
                       least.lower);
  }
  const WallBall& ball = *record.found.thinnest;
  const bool is_measured = record.verdict == WallRecord::Verdict::kMeasured;
  return fmt::format(
      "the thinnest {} is {:.6g} to {:.6g}{}: between {:.6g}, {:.6g}, {:.6g} and {:.6g}, {:.6g}, {:.6g}{}",
      name_of(record), least.lower, least.upper, is_measured ? "" : ", below " + wanted, ball.a[0], ball.a[1],
      ball.a[2], ball.b[0], ball.b[1], ball.b[2],
      is_measured ? fmt::format("; proved for object angles of {:g} and more", record.object_angle) : "");
}

std::string places_table(const std::vector<WallRecord>& records) {
  std::vector<std::vector<std::string>> rows;
  std::string left_out;
  for (const WallRecord& record : records) {
    const std::size_t shown = std::min(record.places.size(), kMostPlaces);
    for (const ThinPlace& place : std::span(record.places).first(shown)) {
      rows.push_back({name_of(record), fmt::format("{:.6g}", place.least.lower),
                      fmt::format("{:.6g}", place.least.upper), fmt::format("{:.6g}", place.at[0]),
                      fmt::format("{:.6g}", place.at[1]), fmt::format("{:.6g}", place.at[2]),
                      place.area > 0 ? fmt::format("{:.3g}", place.area) : "-"});
    }
    if (shown < record.places.size()) {
      left_out += fmt::format("and {} smaller places of thin {}s\n", record.places.size() - shown, name_of(record));
    }
  }
  if (rows.empty()) return {};
  return format_table({{"thin"}, {"from", true}, {"to", true}, {"x", true}, {"y", true}, {"z", true}, {"area", true}},
                      rows) +
         left_out;
}

Status verdict(const std::vector<WallRecord>& records) {
  std::string failed;
  for (const WallRecord& record : records) {
    if (record.verdict == WallRecord::Verdict::kThickEnough) continue;
    if (record.verdict == WallRecord::Verdict::kMeasured) continue;
    failed += (failed.empty() ? "" : "; ") + describe_walls(record);
  }
  return failed.empty() ? Status() : Status(Error{kWallTooThin, failed});
}

}  // namespace medial_vk::cli
