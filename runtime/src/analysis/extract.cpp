#include "analysis/extract.h"

#include <algorithm>
#include <cstdint>
#include <future>
#include <new>
#include <optional>
#include <utility>

#include "base/stopwatch.h"
#include "cpu_reference/extract.h"
#include "judge/reference_bridge.h"
#include "medial_vk/bvh.h"

namespace medial_vk {
namespace {

constexpr std::uint32_t kLeafSize = 4;

Error interrupted() { return {ErrorCode::kInterrupted, "interrupted"}; }

ProgressCallback progress_of_stage(const StageProgress& progress, const char* stage) {
  if (!progress) return {};
  return [&progress, stage](double done) { return progress(stage, done); };
}

Result<Extraction> extract_on_cpu(const PreparedMesh& mesh, const ExtractionParameters& parameters,
                                  const ProgressCallback& progress) {
  const reference::Result result = reference::extract(to_reference(mesh), to_reference(parameters), progress);
  if (result.interrupted) return interrupted();
  return from_reference(result);
}

Result<Extraction> extract(const PreparedMesh& mesh, const MeshIndex* index, const ExtractionParameters& parameters,
                           Backend backend, Context* context, const ProgressCallback& progress) {
  if (backend == Backend::kCpu) return extract_on_cpu(mesh, parameters, progress);
  if (context == nullptr) return Error{ErrorCode::kNoDevice, "the Vulkan backend was asked for without a device"};
  if (index == nullptr) return extract_medial_spheres(*context, mesh.view(), parameters, progress);
  return extract_medial_spheres(*context, mesh.view(), *index, parameters, progress);
}

/// Without an index, the certificate's tree is made while others are at work.
Result<CertifiedExtraction> run_stages(const PreparedMesh& mesh, const MeshIndex* index,
                                       const ExtractionParameters& parameters, Backend backend, Context* context,
                                       unsigned threads, const StageProgress& progress) {
  CertifiedExtraction out;
  Stopwatch stopwatch;
  std::future<Result<Bvh>> indexing;
  if (index == nullptr) {
    indexing = std::async(std::launch::async | std::launch::deferred,
                          [&] { return Bvh::build(mesh.view(), kLeafSize, threads); });
  }
  Result<Extraction> extraction =
      extract(mesh, index, parameters, backend, context, progress_of_stage(progress, "extract"));
  if (!extraction) return extraction.error();
  out.extraction = std::move(extraction).value();
  out.host_times.push_back({"extract", stopwatch.lap()});

  if (progress && !progress("certify", 0.0)) return interrupted();
  std::optional<Bvh> own_tree;
  if (index == nullptr) {
    Result<Bvh> made = indexing.get();
    if (!made) return made.error();
    own_tree.emplace(std::move(made).value());
  }
  const Bvh& tree = index != nullptr ? index->bvh() : *own_tree;
  out.certify = certify_spheres(tree, parameters, longest_side(mesh.report), out.extraction, threads);
  out.host_times.push_back({"certify", stopwatch.lap()});
  if (progress && !progress("certify", 1.0)) return interrupted();
  return out;
}

/// The reference and the standard library may run out of memory anywhere; nothing else throws here.
Result<CertifiedExtraction> run_caught(const PreparedMesh& mesh, const MeshIndex* index,
                                       const ExtractionParameters& parameters, Backend backend, Context* context,
                                       unsigned threads, const StageProgress& progress) {
  try {
    return run_stages(mesh, index, parameters, backend, context, threads, progress);
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::kOutOfMemory, "out of memory while extracting; try a lower --resolution"};
  } catch (const std::exception& error) {
    return Error{ErrorCode::kInternal, error.what()};
  }
}

}  // namespace

double longest_side(const MeshReport& report) {
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) longest = std::max(longest, report.upper[axis] - report.lower[axis]);
  return longest;
}

bool uses_index(const ExtractionParameters& parameters, Backend backend) {
  return backend == Backend::kVulkan && parameters.mode == Mode::kCertified;
}

Result<CertifiedExtraction> extract_and_certify(const PreparedMesh& mesh, const ExtractionParameters& parameters,
                                                Backend backend, Context* context, unsigned threads,
                                                const StageProgress& progress) {
  return run_caught(mesh, nullptr, parameters, backend, context, threads, progress);
}

Result<CertifiedExtraction> extract_and_certify(const PreparedMesh& mesh, const MeshIndex& index,
                                                const ExtractionParameters& parameters, Backend backend,
                                                Context* context, unsigned threads, const StageProgress& progress) {
  return run_caught(mesh, &index, parameters, backend, context, threads, progress);
}

}  // namespace medial_vk
