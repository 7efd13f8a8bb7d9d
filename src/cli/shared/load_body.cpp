#include "cli/shared/load_body.h"

#include <fmt/format.h>

#include <utility>

#include "base/stopwatch.h"
#include "cli/shared/load.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/messages.h"

namespace medial_vk::cli {
namespace {

Error wrong(const std::string& path, const std::string& what) {
  return {ErrorCode::kInvalidMesh, fmt::format("{}: {}", path, what)};
}

std::string point_text(const Point& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

/// A cover of an open mesh covers its surface, which is all of it that a body knows.
Status accept(const SphereProofs& proofs, const LoadedBody& body, const std::string& path) {
  const bool is_closed = body.mesh.prepared().report.closed;
  if (body.inside.empty() && body.cover.empty()) return wrong(path, "the file has no balls");
  if (!is_closed && !body.inside.empty()) {
    return wrong(path, "the mesh is not closed and encloses nothing, but the file has balls inside it");
  }
  if (!proofs.inside.proved()) {
    return wrong(path, fmt::format("ball {} of those inside reaches out of the solid, or is not proved not to",
                                   proofs.inside.first_failure));
  }
  if (body.cover.empty()) return {};
  const CoverProof& cover = proofs.cover;
  if (!cover.surface_proved()) {
    return wrong(path,
                 "the balls of the cover are not proved to cover the surface at " + point_text(cover.first_uncovered));
  }
  if (is_closed && !cover.proved()) {
    return wrong(path, "the balls of the cover are not proved to cover the solid at " + point_text(cover.first_inside));
  }
  return {};
}

}  // namespace

Result<SphereProofs> prove_body(const LoadedBody& body, const std::string& path, unsigned threads) {
  Result<SphereProofs> proofs = prove_spheres(body.mesh, body.inside, body.cover, {threads});
  // Numbers out of range are those of the file.
  const auto code_of = [](ErrorCode code) { return code == ErrorCode::kUsage ? ErrorCode::kInvalidMesh : code; };
  if (!proofs) return Error{code_of(proofs.error().code), fmt::format("{}: {}", path, proofs.error().message)};
  if (Status status = accept(proofs.value(), body, path); !status) return status.error();
  return proofs;
}

Result<LoadedBody> load_body(const BodyFile& file, const std::string& path, unsigned threads,
                             std::vector<StageTime>& times) {
  // Faces were cut along their crossings, and those inside left out, before the balls were fitted.
  const PrepareOptions as_it_is = {.keep_inner_faces = true, .threads = threads, .keep_outer_faces = true};
  Result<PreparedMesh> prepared = prepare_loaded(file.mesh, path, DeviceOpening(), as_it_is, times);
  if (!prepared) return prepared.error();
  const EndAtOnce guard;
  if (interrupted()) return stopped();
  Stopwatch stopwatch;
  Result<IndexedMesh> indexed = IndexedMesh::build(std::move(prepared).value(), {.threads = threads});
  if (!indexed) return wrong(path, indexed.error().message);
  LoadedBody body = {std::move(indexed).value(), file.inside, file.cover};
  const Result<SphereProofs> proofs = prove_body(body, path, threads);
  if (!proofs) return proofs.error();
  times.push_back({"prove", stopwatch.lap()});
  return body;
}

}  // namespace medial_vk::cli
