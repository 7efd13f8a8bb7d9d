#include "cli/voronoi/voronoi_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "medial_vk/version.h"

namespace medial_vk::cli {
namespace {

constexpr std::size_t kMostPairs = 20;           // in the summary
constexpr std::size_t kMostListedVoxels = 1000;  // of a kind, in the report: docs/formats.md states it

std::string sites_text(const SiteRecord& record) {
  std::vector<std::string> kinds;
  for (const char* kind : {"solid", "surface", "point", "segment", "triangle"}) {
    const auto count = static_cast<std::uint64_t>(
        std::ranges::count_if(record.sites, [&](const NamedSite& site) { return site.kind == kind; }));
    if (count > 0) kinds.push_back(counted(count, kind, std::string(kind) + "s"));
  }
  return fmt::format("{}: {}", counted(record.sites.size(), "site", "sites"), fmt::join(kinds, ", "));
}

std::string pair_table(const SiteRecord& record) {
  std::vector<std::vector<std::string>> rows;
  for (const SitePair& pair : pairs_of(record.voronoi)) {
    if (rows.size() == kMostPairs) break;
    rows.push_back({record.sites[pair.sites[0]].name, record.sites[pair.sites[1]].name, grouped(pair.pieces),
                    grouped(pair.faces), fmt::format("{:.6g}", pair.area), fmt::format("{:.6g}", pair.least_clearance),
                    fmt::format("{:.6g}", pair.greatest_clearance)});
  }
  return format_table({{"site"},
                       {"site"},
                       {"pieces", true},
                       {"faces", true},
                       {"area", true},
                       {"least clearance", true},
                       {"greatest", true}},
                      rows);
}

std::string overlap_text(const SiteRecord& record) {
  std::string text;
  for (const auto& [a, b] : record.voronoi.overlaps) {
    if (!text.empty()) text += ", ";
    text += record.sites[a].name + " and " + record.sites[b].name;
  }
  return fmt::format("{} overlap or have faces in common; points inside of solids are left out", text);
}

std::string path_text(const SiteRecord& record) {
  if (!record.path) {
    return fmt::format("none found from {:.6g} to {:.6g} by the links of the roadmap",
                       fmt::join(record.path_ends[0], ","), fmt::join(record.path_ends[1], ","));
  }
  return fmt::format("width {:.6g}, length {:.6g}, {}", record.path->width, record.path->length,
                     counted(record.path->line.size(), "point", "points"));
}

/// The first voxels of each kind, with the places of their middles; files of the surface have all.
nlohmann::ordered_json voxels_json(const SiteVoronoi& voronoi) {
  nlohmann::ordered_json json = {{"listed_at_most", kMostListedVoxels}};
  for (const VoxelsWithoutPoint& kind : voxels_without_point(voronoi)) {
    nlohmann::ordered_json listed = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < std::min(kind.voxels->size(), kMostListedVoxels); ++i) {
      const std::array<std::uint32_t, 3>& voxel = (*kind.voxels)[i];
      Point middle = voronoi.grid.corner(voxel);
      for (double& x : middle) x += voronoi.grid.side / 2;
      listed.push_back({{"voxel", voxel}, {"middle", middle}});
    }
    json[kind.name] = {{"count", kind.voxels->size()}, {"first", listed}};
  }
  return json;
}

}  // namespace

std::string voronoi_summary(const SiteRecord& record, const std::vector<StageTime>& times,
                            std::span<const OutputFile> files, bool verbose) {
  const SiteVoronoi& voronoi = record.voronoi;
  const SiteCounts counts = counts_of(voronoi);
  std::string text = sites_text(record) + "\n";
  for (const std::string& assumption : record.assumptions) text += labelled("note", assumption);
  if (!voronoi.overlaps.empty()) text += labelled("note", overlap_text(record));
  if (!voronoi.tied.empty()) {
    text += labelled("note",
                     fmt::format("{} left out, where the nearest points of two sites are the same, or too near to tell",
                                 counted(voronoi.tied.size(), "voxel", "voxels")));
  }
  text += labelled("grid", fmt::format("{} x {} x {} voxels of {:.6g}", voronoi.grid.size[0], voronoi.grid.size[1],
                                       voronoi.grid.size[2], voronoi.grid.side));
  text += labelled("points",
                   fmt::format("{}; of three sites {}, of four {}; undecided voxels {}", grouped(counts.points),
                               grouped(counts.on_curves), grouped(counts.meetings), grouped(voronoi.undecided.size())));
  text += labelled("clearance", fmt::format("{:.6g} to {:.6g}, within {:.2g}", counts.least_clearance,
                                            counts.greatest_clearance, counts.greatest_error));
  text += labelled("area", fmt::format("{:.6g}", counts.area));
  if (record.roadmap) {
    text += labelled("roadmap", fmt::format("{}, {}", counted(record.roadmap->links().size(), "link", "links"),
                                            counted(record.roadmap->components(), "component", "components")));
  }
  if (record.path_was_sought) text += labelled("path", path_text(record));
  text += pair_table(record);
  text += labelled("time", times_text(times, verbose));
  return text + written_text(files, false);
}

std::string voronoi_report(const SiteRecord& record, const std::vector<StageTime>& times) {
  const SiteVoronoi& voronoi = record.voronoi;
  const SiteCounts counts = counts_of(voronoi);
  nlohmann::ordered_json report = {{"version", version()}, {"sites", nlohmann::ordered_json::array()}};
  for (const NamedSite& site : record.sites) {
    report["sites"].push_back({{"name", site.name}, {"kind", site.kind}, {"elements", site.elements}});
  }
  report["assumptions"] = record.assumptions;
  report["options"] = {{"resolution", record.options.resolution}, {"margin", record.options.margin}};
  report["grid"] = {{"origin", voronoi.grid.origin}, {"voxel_side", voronoi.grid.side}, {"size", voronoi.grid.size}};
  report["surface"] = {{"points", counts.points},
                       {"points_of_three_sites", counts.on_curves},
                       {"points_of_four_sites", counts.meetings},
                       {"faces", voronoi.faces.size()},
                       {"pieces", voronoi.pieces.size()},
                       {"area", counts.area},
                       {"least_clearance", counts.least_clearance},
                       {"greatest_clearance", counts.greatest_clearance},
                       {"greatest_error", counts.greatest_error},
                       {"undecided_voxels", voronoi.undecided.size()},
                       {"tied_voxels", voronoi.tied.size()},
                       {"overlapping_voxels", voronoi.overlapping.size()},
                       {"overlaps", voronoi.overlaps},
                       {"cells", voronoi.cells}};
  report["voxels"] = voxels_json(voronoi);
  report["pairs"] = nlohmann::ordered_json::array();
  for (const SitePair& pair : pairs_of(voronoi)) {
    report["pairs"].push_back({{"sites", pair.sites},
                               {"pieces", pair.pieces},
                               {"faces", pair.faces},
                               {"area", pair.area},
                               {"least_clearance", pair.least_clearance},
                               {"greatest_clearance", pair.greatest_clearance}});
  }
  if (record.roadmap) {
    report["roadmap"] = {{"links", record.roadmap->links().size()}, {"components", record.roadmap->components()}};
  }
  if (record.path_was_sought) {
    report["path"] = nullptr;
    if (record.path) report["path"] = {{"width", record.path->width}, {"length", record.path->length}};
  }
  for (const StageTime& time : times) report["seconds"][time.stage] = time.seconds;
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk::cli
