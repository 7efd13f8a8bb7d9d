#include <exception>
#include <new>
#include <utility>

#include "base/host_memory.h"
#include "base/stopwatch.h"
#include "medial_vk/certify.h"

namespace medial_vk {
namespace {

Error interrupted() { return {ErrorCode::kInterrupted, "interrupted"}; }

Result<CertifiedExtraction> run_stages(const IndexedMesh& mesh, const ExtractionOptions& options,
                                       const Extractor& extractor, const StageProgress& progress,
                                       const std::stop_token& stop) {
  CertifiedExtraction out;
  Stopwatch stopwatch;
  const auto on_progress = [&progress](double done) { progress("extract", done); };
  Result<Extraction> extraction =
      extractor(mesh, options, progress ? ProgressCallback(on_progress) : ProgressCallback(), stop);
  if (!extraction) return extraction.error();
  out.extraction = std::move(extraction).value();
  out.extraction.measurements.host_times.push_back({"extract", stopwatch.lap()});

  if (progress) progress("certify", 0.0);
  if (stop.stop_requested()) return interrupted();
  Result<CertificateReport> certificate = certify_spheres(mesh, options, out.extraction);
  if (!certificate) return certificate.error();
  out.certificate = certificate.value();
  out.extraction.measurements.host_times.push_back({"certify", stopwatch.lap()});
  if (progress) progress("certify", 1.0);
  if (stop.stop_requested()) return interrupted();
  return out;
}

}  // namespace

Result<CertifiedExtraction> extract_and_certify(const IndexedMesh& mesh, const ExtractionOptions& options,
                                                const Extractor& extractor, const StageProgress& progress,
                                                const std::stop_token& stop) {
  try {
    return run_stages(mesh, options, extractor, progress, stop);
  } catch (const std::bad_alloc&) {
    return out_of_memory("extracting", "try a lower `resolution`");
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, error.what()};
  }
}

Result<CertifiedExtraction> extract_and_certify(const IndexedMesh& mesh, const ExtractionOptions& options,
                                                Context& context, const StageProgress& progress,
                                                const std::stop_token& stop) {
  return extract_and_certify(mesh, options, device_extractor(context), progress, stop);
}

}  // namespace medial_vk
