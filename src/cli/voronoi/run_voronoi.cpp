#include "cli/voronoi/run_voronoi.h"

#include <fmt/format.h>

#include <algorithm>
#include <stop_token>
#include <utility>

#include "base/stopwatch.h"
#include "cli/help/help_texts.h"
#include "cli/options/voronoi/voronoi_options.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/tables.h"
#include "cli/voronoi/load_sites.h"
#include "cli/voronoi/plane_sites.h"
#include "cli/voronoi/voronoi_summary.h"
#include "output/atomic_files/atomic_file.h"
#include "output/page/page.h"
#include "output/plane_files/plane_files.h"
#include "output/plane_page/plane_page.h"
#include "output/plane_picture/plane_picture.h"
#include "output/site_files/site_files.h"
#include "output/site_page/site_page.h"
#include "output/site_picture/site_picture.h"
#include "reference_bridge/check_plane_voronoi.h"
#include "reference_bridge/check_site_voronoi.h"

namespace medial_vk::cli {
namespace {

/// The steps from sites to files, in space and in the plane, and their shared data.
class VoronoiRun {
 public:
  explicit VoronoiRun(const VoronoiCommandOptions& options) : options_(options), progress_(!options.quiet) {}

  Status run() {
    if (!options_.html.empty()) {
      if (Status status = check_page_available(); !status) return status;
    }
    for (const NamedOutput& output : outputs_of(options_)) {
      if (output.file->empty()) continue;
      if (Status status = check_writable(*output.file); !status) return status;
    }
    if (Status status = options_.in_plane ? run_in_plane() : run_in_space(); !status) return status;
    if (interrupted()) return stopped();
    if (Status status = write_files(files_); !status) return status;
    if (!options_.quiet) {
      print_message(options_.in_plane
                        ? plane_sites_summary(plane_, times_, options_.verbose) + written_text(files_, false)
                        : voronoi_summary(record_, times_, files_, options_.verbose));
    }
    if (!options_.check) return {};
    return print_check(check_, std::ranges::any_of(files_, [](const OutputFile& file) { return file.path == "-"; }));
  }

 private:
  Status run_in_space() {
    if (Status status = load(); !status) return status;
    if (Status status = check_ends(); !status) return status;
    if (Status status = find(); !status) return status;
    if (Status status = make_roadmap(); !status) return status;
    if (Status status = check(); !status) return status;
    return make_files();
  }

  Status load() {
    const EndAtOnce guard;  // a pipe may wait
    if (interrupted()) return stopped();
    progress_.update("read", 0);
    Result<std::vector<VoronoiSite>> sites = load_sites(options_, record_, times_);
    progress_.clear();
    if (!sites) return sites.error();
    sites_ = std::move(sites).value();
    return {};
  }

  /// Runs `work(progress, stop)`, which a signal ends.
  template <class Work>
  auto stoppable(const char* stage, const Work& work) {
    Stopwatch stopwatch;
    std::stop_source stop;
    const auto on_progress = [&](double done) {
      progress_.update(stage, done);
      if (interrupted()) stop.request_stop();
    };
    auto result = work(ProgressCallback(on_progress), stop.get_token());
    progress_.clear();
    times_.push_back({stage, stopwatch.lap()});
    return result;
  }

  Error in_words(Error error) const {
    if (error.code == ErrorCode::kInterrupted) return stopped();
    // The library numbers sites; their names follow.
    if (error.code == ErrorCode::kInvalidMesh && !record_.sites.empty()) {
      error.message += "; sites:";
      for (std::size_t s = 0; s < std::min<std::size_t>(record_.sites.size(), 10); ++s) {
        error.message += fmt::format("{} {} {}", s > 0 ? "," : "", s, record_.sites[s].name);
      }
    }
    return error;
  }

  /// Before the search, which may take long.
  Status check_ends() {
    if (!options_.from) return {};
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    const Status status = check_path_ends(sites_, *options_.from, *options_.to, options_.threads);
    if (!status) return in_words(status.error());
    return {};
  }

  Status find() {
    record_.options.resolution = options_.resolution;
    record_.options.margin = options_.margin;
    record_.options.threads = options_.threads;
    Result<SiteVoronoi> found = stoppable("search", [&](const ProgressCallback& progress, const std::stop_token& stop) {
      return find_site_voronoi(sites_, record_.options, progress, stop);
    });
    if (!found) return in_words(found.error());
    record_.voronoi = std::move(found).value();
    return {};
  }

  /// Nothing is lost if the process ends: trees and paths do not ask for a stop.
  Status make_roadmap() {
    if (options_.roadmap.empty()) return {};
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    SiteRoadmapOptions how;
    how.threads = options_.threads;
    Result<SiteRoadmap> roadmap =
        stoppable("roadmap", [&](const ProgressCallback& progress, const std::stop_token& stop) {
          return SiteRoadmap::build(sites_, record_.voronoi, how, progress, stop);
        });
    if (!roadmap) return in_words(roadmap.error());
    record_.roadmap = std::move(roadmap).value();
    if (!options_.from) return {};
    record_.path_was_sought = true;
    record_.path_ends = {*options_.from, *options_.to};
    Result<std::optional<SitePath>> path = record_.roadmap->widest_path(*options_.from, *options_.to);
    if (!path) return path.error();
    record_.path = std::move(path).value();
    return {};
  }

  /// The reference cannot be stopped half-way, but nothing is lost if the process ends.
  Status check() {
    if (!options_.check) return {};
    const EndAtOnce while_checked;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    check_ = check_site_voronoi(sites_, record_.voronoi, [&](double done) { progress_.update("check", done); });
    progress_.clear();
    times_.push_back({"check", stopwatch.lap()});
    return {};
  }

  /// Files are made in memory: until they are written a signal may end the program.
  Status make_files() {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    progress_.update("files", 0);
    Result<std::string> surface = encode();
    if (!surface) return surface.error();
    files_.push_back({options_.output, std::move(surface).value()});
    if (record_.roadmap) files_.push_back({options_.roadmap, encode_roadmap_json(record_)});
    if (!options_.picture.empty()) {
      Result<std::string> png = encode_png(draw_sites(record_, sites_, options_.picture_options));
      if (!png) return png.error();
      files_.push_back({options_.picture, std::move(png).value()});
    }
    if (!options_.html.empty()) {
      files_.push_back({options_.html, encode_site_page(record_, sites_, options_.picture_options.view.up)});
    }
    progress_.clear();
    times_.push_back({"files", stopwatch.lap()});
    if (!options_.report.empty()) files_.push_back({options_.report, voronoi_report(record_, times_)});
    return {};
  }

  Result<std::string> encode() const {
    switch (options_.format()) {
      case SitesFormat::kObj:
        return encode_sites_obj(record_);
      case SitesFormat::kGlb:
        return encode_sites_glb(record_);
      case SitesFormat::kNpz:
        return encode_sites_npz(record_);
      case SitesFormat::kCsv:
        return encode_sites_csv(record_);
      case SitesFormat::kJson:
        return encode_sites_json(record_);
      default:
        return encode_sites_ply(record_, options_.ascii);
    }
  }

  Status run_in_plane() {
    const auto load = [&]() -> Result<PlaneSites> {
      const EndAtOnce guard;
      if (interrupted()) return stopped();
      return load_plane_sites(options_, plane_, times_);
    };
    const Result<PlaneSites> sites = load();
    if (!sites) return sites.error();
    if (Status status = check_plane_ends(options_, plane_.shape); !status) return status;
    const Status found = stoppable("search", [&](const ProgressCallback& progress, const std::stop_token& stop) {
      return find_plane_curves(sites.value(), options_, progress, stop, plane_);
    });
    if (!found) return in_words(found.error());
    if (Status status = finish_curves(sites.value()); !status) return status;
    Stopwatch stopwatch;
    files_.push_back({options_.output, encode_in_plane()});
    if (plane_.roadmap) files_.push_back({options_.roadmap, encode_plane_roadmap_json(plane_)});
    if (!options_.picture.empty()) {
      Result<std::string> png = encode_png(draw_plane(plane_));
      if (!png) return png.error();
      files_.push_back({options_.picture, std::move(png).value()});
    }
    if (!options_.html.empty()) files_.push_back({options_.html, encode_plane_page(plane_)});
    times_.push_back({"files", stopwatch.lap()});
    if (!options_.report.empty()) files_.push_back({options_.report, plane_sites_report(plane_, times_)});
    return {};
  }

  /// The roadmap and the check. They cannot be stopped half-way, but nothing is lost if the process ends.
  Status finish_curves(const PlaneSites& sites) {
    const EndAtOnce guard;
    if (interrupted()) return stopped();
    Stopwatch stopwatch;
    if (!options_.roadmap.empty()) {
      if (Status status = make_plane_roadmap(sites, options_, plane_); !status) return status;
      times_.push_back({"roadmap", stopwatch.lap()});
    }
    if (!options_.check) return {};
    check_ = check_plane_voronoi(sites, plane_.axis, plane_.roadmap ? &*plane_.roadmap : nullptr,
                                 plane_.path ? &*plane_.path : nullptr,
                                 [&](double done) { progress_.update("check", done); });
    progress_.clear();
    times_.push_back({"check", stopwatch.lap()});
    return {};
  }

  std::string encode_in_plane() const {
    switch (options_.format()) {
      case SitesFormat::kGeoJson:
        return encode_plane_geojson(plane_);
      case SitesFormat::kSvg:
        return encode_plane_svg(plane_);
      case SitesFormat::kCsv:
        return encode_plane_csv(plane_);
      default:
        return encode_plane_json(plane_);
    }
  }

  const VoronoiCommandOptions& options_;
  Progress progress_;
  std::vector<VoronoiSite> sites_;
  SiteRecord record_;
  PlaneRecord plane_;
  CheckReport check_;
  std::vector<StageTime> times_;
  std::vector<OutputFile> files_;
};

}  // namespace

Status run_voronoi(const std::vector<std::string>& arguments) {
  const Result<VoronoiCommandOptions> options = parse_voronoi_options(arguments);
  if (!options) return options.error();
  if (options.value().help) return print_result(voronoi_help_text());
  return VoronoiRun(options.value()).run();
}

}  // namespace medial_vk::cli
