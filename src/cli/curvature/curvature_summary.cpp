#include "cli/curvature/curvature_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/terminal/numbers.h"
#include "cli/terminal/tables.h"
#include "medial_vk/version.h"

namespace medial_vk::cli {
namespace {

ValueRange range_of(std::vector<double> values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return {kNone, kNone, kNone};
  const auto [least, greatest] = std::ranges::minmax(values);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return {least, *middle, greatest};
}

std::string range_text(const ValueRange& range) {
  if (std::isnan(range.median)) return "not known";
  return fmt::format("{:.4g} to {:.4g}, median {:.4g}", range.least, range.greatest, range.median);
}

nlohmann::ordered_json range_json(const ValueRange& range) {
  if (std::isnan(range.median)) return nullptr;
  return {{"least", range.least}, {"median", range.median}, {"greatest", range.greatest}};
}

}  // namespace

CurvatureSummary summarize(const std::string& balls_file, const CurvatureTable& table) {
  CurvatureSummary out;
  out.balls_file = balls_file;
  out.method = name_of(table.method);
  out.balls = table.balls.size();
  out.spacing = table.curvature.spacing;
  std::array<std::vector<double>, 2> kappa;
  std::vector<double> errors;
  for (const BallCurvature& ball : table.curvature.balls) {
    for (const TipCurvature& tip : ball.tips) {
      ++out.tips[static_cast<std::size_t>(tip.state)];
      for (std::size_t k = 0; k < 2; ++k) {
        if (!std::isnan(tip.kappa[k])) kappa[k].push_back(tip.kappa[k]);
      }
      if (!std::isnan(tip.error)) errors.push_back(tip.error);
    }
  }
  for (std::size_t k = 0; k < 2; ++k) out.kappa[k] = range_of(std::move(kappa[k]));
  out.error = range_of(std::move(errors));
  return out;
}

std::string curvature_summary(const CurvatureSummary& summary, const std::vector<StageTime>& times,
                              std::span<const OutputFile> files, bool verbose) {
  std::string text = fmt::format("{}: {}, {:.4g} apart\n", summary.balls_file, counted(summary.balls, "ball", "balls"),
                                 summary.spacing);
  std::string states;
  for (std::size_t i = 0; i < summary.tips.size(); ++i) {
    if (summary.tips[i] == 0) continue;
    states += fmt::format("{}{} {}", states.empty() ? "" : ", ", grouped(summary.tips[i]),
                          state_name(static_cast<CurvatureState>(i)));
  }
  text += labelled("tips", states);
  text += labelled("kappa 1", range_text(summary.kappa[0]));
  text += labelled("kappa 2", range_text(summary.kappa[1]));
  text += labelled("error", range_text(summary.error));
  text += labelled("time", times_text(times, verbose));
  return text + written_text(files);
}

std::string curvature_report(const CurvatureSummary& summary, const std::vector<StageTime>& times) {
  nlohmann::ordered_json report;
  report["version"] = version();
  report["balls_file"] = summary.balls_file;
  report["method"] = summary.method;
  report["balls"] = summary.balls;
  report["spacing"] = summary.spacing;
  for (std::size_t i = 0; i < summary.tips.size(); ++i) {
    report["tips"][std::string(state_name(static_cast<CurvatureState>(i)))] = summary.tips[i];
  }
  report["kappa_1"] = range_json(summary.kappa[0]);
  report["kappa_2"] = range_json(summary.kappa[1]);
  report["error"] = range_json(summary.error);
  for (const StageTime& time : times) report["seconds"][time.stage] = time.seconds;
  return report.dump(2) + "\n";
}

}  // namespace medial_vk::cli
