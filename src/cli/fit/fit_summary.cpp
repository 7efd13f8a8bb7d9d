#include "cli/fit/fit_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "medial_vk/version.h"

namespace medial_vk::cli {
namespace {

using OrderedJson = nlohmann::ordered_json;  // Keys keep their order, which is chosen for readers.

/// The number of the layout, raised when a key changes its meaning.
constexpr int kFitReportFormat = 1;
constexpr std::array<const char*, 4> kManyOfKind = {"balls", "capsules", "cones", "slabs"};

std::string where_it_ran(const HullRecord& record) {
  if (record.backend == Backend::kCpu) return "CPU reference, double precision";
  if (!record.device) return "Vulkan";
  return fmt::format("{} ({}), {}", record.device->name, record.device->type, record.device->driver);
}

std::string hulls_text(const HullRecord& record) {
  const std::array<std::size_t, 4> kinds = kinds_of(record.fit.hulls);
  std::string text;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (kinds[k] == 0) continue;
    if (!text.empty()) text += ", ";
    text += counted(kinds[k], name_of(static_cast<HullKind>(k)), kManyOfKind[k]);
  }
  text = fmt::format("{} with {}", text, counted(parameters_in(record.fit.hulls), "number", "numbers"));
  const std::size_t left_out = record.fit.left_out;
  if (left_out > 0) text += fmt::format("; {} left out beside openings of the mesh", left_out);
  if (record.fit.hulls.size() + left_out < record.options.count && record.options.parameters == 0 &&
      record.options.error == 0 && record.options.max_gap == 0)
    text += "; the search finds no more";
  return text;
}

/// Two bounds with the digits in which they differ, and at least three.
std::string between(double lower, double upper) {
  if (lower == upper) return fmt::format("{:.4g}", upper);
  const double places = upper > 0 ? std::ceil(std::log10(upper / (upper - lower))) : 0;
  const int digits = static_cast<int>(std::clamp(places + 1, 3.0, 12.0));
  return fmt::format("{:.{}g} to {:.{}g}", lower, digits, upper, digits);
}

std::string proof_text(const HullFit& fit) {
  std::string text = fmt::format("{} inside, by {}", counted(fit.proof.tested, "hull", "hulls"),
                                 counted(fit.proof.planes, "plane", "planes"));
  if (fit.greatest_shrink > 0) text += fmt::format("; radii gave way by up to {:.2g}", fit.greatest_shrink);
  return text;
}

std::string hull_table(const HullRecord& record) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < record.fit.hulls.size(); ++i) {
    const BallHull& hull = record.fit.hulls[i];
    const auto [least, greatest] = std::ranges::minmax(hull.balls(), {}, &Ball::radius);
    rows.push_back({fmt::format("{}", i + 1), name_of(kind_of(hull)), fmt::format("{:.4g}", volume_of(hull)),
                    fmt::format("{:.4g}", least.radius), fmt::format("{:.4g}", greatest.radius)});
  }
  return format_table({{"hull", true}, {"kind"}, {"volume", true}, {"least radius", true}, {"greatest radius", true}},
                      rows);
}

OrderedJson bounds_json(const Bounds& bounds) { return {bounds.lower, bounds.upper}; }

OrderedJson goals_of_fit(const HullFitOptions& options) {
  const auto given = [](auto value) { return value > 0 ? OrderedJson(value) : OrderedJson(nullptr); };
  return {{"count", given(options.count)}, {"parameters", given(options.parameters)},
          {"error", given(options.error)}, {"max_gap", given(options.max_gap)},
          {"width", given(options.width)}, {"resolution", given(options.resolution)}};
}

OrderedJson check_json(const std::optional<CheckReport>& check) {
  if (!check) return nullptr;
  return check->passed() ? "passed" : "failed";
}

}  // namespace

std::string fit_opening(const HullRecord& record) {
  std::string text = fmt::format("{}: {}\n", record.input == "-" ? "standard input" : record.input,
                                 counted(record.mesh.triangles, "triangle", "triangles"));
  for (const std::string& assumption : record.mesh.assumptions) text += labelled("note", assumption);
  return text + labelled("device", where_it_ran(record));
}

std::string fit_summary(const HullRecord& record, std::span<const OutputFile> files, bool verbose) {
  const HullFit& fit = record.fit;
  std::string text = labelled("hulls", hulls_text(record));
  text += labelled("proved", proof_text(fit));
  if (const std::optional<Bounds> share = uncovered_share(record)) {
    text += labelled(
        "error", fmt::format("{} % of the volume is left uncovered", between(100 * share->lower, 100 * share->upper)));
  } else {
    text += labelled("volume", fmt::format("{} of the hulls; the mesh encloses none that is certain",
                                           between(fit.covered.lower, fit.covered.upper)));
  }
  text += labelled("gap", fmt::format("{} is the greatest distance from the surface to the hulls",
                                      between(fit.gap.lower, fit.gap.upper)));
  text += labelled("time", times_text(record.times, verbose));
  if (verbose) text += hull_table(record);
  return text + written_text(files, false);
}

std::string fit_report(const HullRecord& record) {
  const HullFit& fit = record.fit;
  const std::optional<Bounds> share = uncovered_share(record);
  const std::array<std::size_t, 4> kinds = kinds_of(fit.hulls);
  OrderedJson of_kinds, seconds = OrderedJson::object();
  for (std::size_t k = 0; k < kinds.size(); ++k) of_kinds[kManyOfKind[k]] = kinds[k];
  for (const StageTime& time : record.times) seconds[time.stage] = time.seconds;
  const OrderedJson report = {
      {"format", kFitReportFormat},
      {"program", "medial-vk fit"},
      {"version", version()},
      {"input", record.input},
      {"output", record.output},
      {"output_format", record.output_format},
      {"mesh", record.name},
      {"triangles", record.mesh.triangles},
      {"longest_side", record.mesh.longest_side()},
      {"closed", record.mesh.closed},
      {"assumptions", record.mesh.assumptions},
      {"primitives", name_of(record.options.choice)},
      {"backend", record.backend == Backend::kCpu ? "cpu" : "vulkan"},
      {"device", record.device ? OrderedJson(record.device->name) : OrderedJson(nullptr)},
      {"goals", goals_of_fit(record.options)},
      {"num_hulls", fit.hulls.size()},
      {"num_parameters", parameters_in(fit.hulls)},
      {"hulls", of_kinds},
      {"solid_volume", fit.solid_volume ? OrderedJson(*fit.solid_volume) : OrderedJson(nullptr)},
      {"hulls_volume", bounds_json(fit.covered)},
      {"uncovered_share", share ? bounds_json(*share) : OrderedJson(nullptr)},
      {"gap", bounds_json(fit.gap)},
      {"proof",
       {{"tested", fit.proof.tested},
        {"failed", fit.proof.failed},
        {"planes", fit.proof.planes},
        {"greatest_shrink", fit.greatest_shrink}}},
      {"check", check_json(record.check)},
      {"seconds", seconds}};
  return report.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

}  // namespace medial_vk::cli
