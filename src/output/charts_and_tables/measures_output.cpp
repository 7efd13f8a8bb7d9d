#include "output/charts_and_tables/measures_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "output/charts_and_tables/svg_drawing.h"

namespace medial_vk {
namespace {

using Json = nlohmann::ordered_json;

Json bounds_json(const Bounds& bounds) { return {{"lower", bounds.lower}, {"upper", bounds.upper}}; }

Json histogram_json(const SignedDistances& histogram) {
  return {{"lower", histogram.lower},
          {"upper", histogram.upper},
          {"share", histogram.share},
          {"least", histogram.least},
          {"greatest", histogram.greatest},
          {"mean", histogram.mean},
          {"mean_absolute", histogram.mean_absolute}};
}

Json certificate_json(const SphereMeasures& measures) {
  const InsideProof& inside = measures.inside;
  const CoverProof& cover = measures.cover;
  return {{"inside",
           {{"proved", inside.proved()},
            {"balls", inside.tested},
            {"failed", inside.failed},
            {"worst", inside.greatest_excess}}},
          {"cover",
           {{"proved", cover.proved()},
            {"closed", cover.closed},
            {"triangles", cover.triangles},
            {"uncovered", cover.uncovered},
            {"undecided", cover.undecided},
            {"envelope_vertices", cover.vertices},
            {"vertices_inside", cover.inside}}}};
}

/// A length, and its share of the diagonal.
std::string length_text(double x, double diagonal) {
  return fmt::format("{:.6g} ({:.3f} % of the diagonal)", x, 100 * x / diagonal);
}

std::string bounds_text(const Bounds& bounds, double diagonal) {
  return fmt::format("{:.6g} to {:.6g} ({:.3f} to {:.3f} % of the diagonal)", bounds.lower, bounds.upper,
                     100 * bounds.lower / diagonal, 100 * bounds.upper / diagonal);
}

class Table {
 public:
  void row(const char* name, const std::string& value) { text_ += fmt::format("{:<24}{}\n", name, value); }
  std::string text() const { return text_; }

 private:
  std::string text_;
};

// Dimensions of the drawing, in its units.
constexpr double kWidth = 640, kPanel = 200, kLeft = 64, kRight = 16, kTop = 28, kBottom = 44;

class HistogramDrawing {
 public:
  HistogramDrawing(const SignedDistances& any, double most, double diagonal)
      : lower_(100 * any.lower / diagonal),
        upper_(100 * any.upper / diagonal),
        most_(most),
        diagonal_(diagonal),
        out_(kWidth, 2 * kPanel) {}

  void panel(const SignedDistances& histogram, int row, const char* name) {
    base_ = kPanel * row + kPanel - kBottom;
    out_.text(kLeft, base_ - height() - 12, "start", name);
    const double width = (kWidth - kLeft - kRight) / static_cast<double>(histogram.share.size());
    for (std::size_t i = 0; i < histogram.share.size(); ++i) {
      const double tall = height() * histogram.share[i] / most_;
      if (tall > 0) out_.bar(kLeft + width * static_cast<double>(i), base_ - tall, width * 0.92, tall, "bar");
    }
    axes();
    const double mean = x(100 * histogram.mean / diagonal_);
    out_.line(mean, base_, mean, base_ - height(), "mean");
  }

  std::string finish() const { return out_.finish(".bar{fill:#0072b2}.mean{stroke:#d55e00;stroke-dasharray:6 3}"); }

 private:
  static double height() { return kPanel - kTop - kBottom; }
  double x(double percent) const { return kLeft + (kWidth - kLeft - kRight) * (percent - lower_) / (upper_ - lower_); }

  void axes() {
    const double step = tick_step(upper_ - lower_);
    const double first = std::ceil(lower_ / step);
    for (int k = 0; step * (first + k) <= upper_; ++k) {
      const double tick = step * (first + k);
      out_.line(x(tick), base_, x(tick), base_ + 4, "axis");
      out_.text(x(tick), base_ + 18, "middle", fmt::format("{:.3g}", std::fabs(tick) < 1e-9 * step ? 0.0 : tick));
    }
    out_.line(kLeft, base_, kWidth - kRight, base_, "axis");
    out_.line(kLeft, base_, kLeft, base_ - height(), "axis");
    out_.text(kLeft - 8, base_ - height() + 4, "end", fmt::format("{:.0f} %", 100 * most_));
    out_.text((kLeft + kWidth - kRight) / 2, base_ + 36, "middle",
              "signed distance, % of the diagonal (positive: outside the solid)");
  }

  double lower_, upper_, most_, diagonal_;
  double base_ = 0;
  SvgDrawing out_;
};

void append_rows(std::string& text, const char* surface, const SignedDistances& histogram) {
  const std::size_t count = histogram.share.size();
  const double width = (histogram.upper - histogram.lower) / static_cast<double>(std::max<std::size_t>(count, 1));
  for (std::size_t i = 0; i < count; ++i) {
    text += fmt::format("{},{},{},{}\n", surface, histogram.lower + width * static_cast<double>(i),
                        histogram.lower + width * static_cast<double>(i + 1), histogram.share[i]);
  }
}

}  // namespace

Json measures_json(const SphereMeasures& measures) {
  const VolumeError& volume = measures.volume;
  const EnvelopeDistances& d = measures.distances;
  const SphereFitMetrics& m = measures.metrics;
  return {{"certificate", certificate_json(measures)},
          {"volume",
           {{"solid", volume.solid},
            {"balls", volume.balls},
            {"uncovered", volume.uncovered},
            {"outside", volume.outside},
            {"standard_error", volume.standard_error},
            {"error", volume.normalized()},
            {"error_standard_error", volume.normalized_standard_error()},
            {"error_lower_bound", volume.normalized_lower_bound()}}},
          {"diagonal", measures.diagonal},
          {"distances",
           {{"solid_to_balls", bounds_json(d.solid_to_balls)},
            {"balls_to_solid", bounds_json(d.balls_to_solid)},
            {"boundary_to_balls", bounds_json(d.boundary_to_balls)},
            {"boundary_to_envelope", bounds_json(d.boundary_to_envelope)},
            {"envelope_to_boundary", bounds_json(d.envelope_to_boundary)},
            {"hausdorff_of_sets", bounds_json(d.between_sets())},
            {"hausdorff_of_surfaces", bounds_json(d.between_surfaces())}}},
          {"metrics",
           {{"num_spheres", m.num_spheres},
            {"coverage", m.coverage},
            {"protrusion", m.protrusion},
            {"protrusion_dist_mean", m.protrusion_dist_mean},
            {"protrusion_dist_p95", m.protrusion_dist_p95},
            {"surface_gap_mean", m.surface_gap_mean},
            {"surface_gap_p95", m.surface_gap_p95},
            {"max_uncovered_gap", m.max_uncovered_gap},
            {"volume_ratio", m.volume_ratio}}},
          {"histograms",
           {{"boundary_to_envelope", histogram_json(measures.histograms.boundary_to_envelope)},
            {"envelope_to_boundary", histogram_json(measures.histograms.envelope_to_boundary)}}}};
}

std::string measures_text(const SphereMeasures& measures) {
  const VolumeError& volume = measures.volume;
  const EnvelopeDistances& d = measures.distances;
  const SphereFitMetrics& m = measures.metrics;
  const double diagonal = measures.diagonal;
  const std::string plus = volume.standard_error > 0
                               ? fmt::format(" +- {:.3f} % (standard error)", 100 * volume.normalized_standard_error())
                               : std::string(" (exact)");
  Table table;
  table.row("num_spheres", fmt::format("{}", m.num_spheres));
  table.row("inside",
            measures.inside.proved() ? "proved" : fmt::format("no: {} balls reach out", measures.inside.failed));
  table.row("cover", measures.cover.proved() ? "proved" : "no");
  table.row("volume error", fmt::format("{:.4f} %{}", 100 * volume.normalized(), plus));
  table.row("coverage", fmt::format("{:.6f}", m.coverage));
  table.row("volume_ratio", fmt::format("{:.4f}", m.volume_ratio));
  table.row("solid to balls", bounds_text(d.solid_to_balls, diagonal));
  table.row("balls to solid", bounds_text(d.balls_to_solid, diagonal));
  table.row("boundary to envelope", bounds_text(d.boundary_to_envelope, diagonal));
  table.row("envelope to boundary", bounds_text(d.envelope_to_boundary, diagonal));
  table.row("Hausdorff, surfaces", bounds_text(d.between_surfaces(), diagonal));
  table.row("protrusion", fmt::format("{:.6f}", m.protrusion));
  table.row("protrusion_dist_mean", length_text(m.protrusion_dist_mean, diagonal));
  table.row("protrusion_dist_p95", length_text(m.protrusion_dist_p95, diagonal));
  table.row("surface_gap_mean", length_text(m.surface_gap_mean, diagonal));
  table.row("surface_gap_p95", length_text(m.surface_gap_p95, diagonal));
  table.row("max_uncovered_gap", length_text(m.max_uncovered_gap, diagonal));
  return table.text();
}

std::string encode_histograms_svg(const SphereMeasures& measures) {
  const DistanceHistograms& histograms = measures.histograms;
  double most = 0.01;
  for (const SignedDistances* each : {&histograms.boundary_to_envelope, &histograms.envelope_to_boundary}) {
    for (const double share : each->share) most = std::max(most, share);
  }
  HistogramDrawing drawing(histograms.boundary_to_envelope, most, measures.diagonal);
  drawing.panel(histograms.boundary_to_envelope, 0, "from the boundary to the envelope of the balls, share of area");
  drawing.panel(histograms.envelope_to_boundary, 1, "from the envelope of the balls to the boundary, share of area");
  return drawing.finish();
}

std::string encode_histograms_csv(const SphereMeasures& measures) {
  std::string text = "surface,lower,upper,share\n";
  append_rows(text, "boundary", measures.histograms.boundary_to_envelope);
  append_rows(text, "envelope", measures.histograms.envelope_to_boundary);
  return text;
}

}  // namespace medial_vk
